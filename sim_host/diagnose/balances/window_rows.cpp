#include "sim_host/diagnose/balances/window_rows.hpp"

#include <cmath>
#include <numbers>

namespace morepro::host {
namespace {

Eigen::RowVectorXf test_function(int periods, bool is_sine) {
  Eigen::RowVectorXd phi(static_cast<Eigen::Index>(kWindowLength));
  for (Eigen::Index i = 0; i < phi.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(kWindowLength);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(periods) * place;
    phi(i) = std::pow(std::sin(std::numbers::pi * place), 4) * (is_sine ? std::sin(angle) : std::cos(angle));
  }
  return phi.normalized().cast<float>();
}

}  // namespace

double mean_power(const std::vector<WindowPower>& windows) {
  double sum = 0.0;
  double rows = 0.0;
  for (const WindowPower& window : windows)
    for (std::size_t band = 0; band < kBands; ++band) {
      sum += rows_of_band(band) * window.power[band];
      rows += rows_of_band(band);
    }
  return rows > 0.0 ? sum / rows : 1.0;
}

const Eigen::MatrixXf& test_functions() {
  static const Eigen::MatrixXf functions = [] {
    Eigen::MatrixXf phi(static_cast<Eigen::Index>(kRowsPerWindow), static_cast<Eigen::Index>(kWindowLength));
    for (std::size_t r = 0; r < kRowsPerWindow; ++r)
      phi.row(static_cast<Eigen::Index>(r)) =
          test_function(kBandPeriods[band_of_row(r)], r > 0 && r % 2 == 0);
    return phi;
  }();
  return functions;
}

}  // namespace morepro::host
