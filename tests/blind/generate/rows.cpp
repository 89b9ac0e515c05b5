#include "rows.hpp"

#include <cmath>

namespace blind {
namespace {

template <typename Value>
std::vector<double> intervals(const Columns& c, Value value) {
  std::vector<double> result(c.size() - 1);
  for (std::size_t k = 0; k + 1 < c.size(); ++k) result[k] = value(k);
  return result;
}

std::vector<double> trapezoid(const Columns& c, const std::vector<double>& signal) {
  return intervals(c, [&](std::size_t k) { return 0.5 * c.sample_s * (signal[k] + signal[k + 1]); });
}

std::vector<double> increments(const Columns& c, const std::vector<double>& signal) {
  return intervals(c, [&](std::size_t k) { return signal[k + 1] - signal[k]; });
}

std::vector<double> contact_integral(const Columns& c, const Machine& m) {
  return intervals(c, [&](std::size_t k) {
    if (c.contact[k] <= 0.0) return 0.0;
    const double heat = heat_factor(m, c.tool_c[k]);
    return 0.5 * c.sample_s * c.contact[k] *
           (contact_torque(m, c.w[k], c.chip_load[k], heat) +
            contact_torque(m, c.w[k + 1], c.chip_load[k], heat));
  });
}

SampleColumns feed_columns(const Columns& c, const Machine& m) {
  const double h = c.sample_s;
  SampleColumns s{increments(c, c.v),
                  {intervals(c, [&](std::size_t k) { return h * c.force[k]; }),
                   intervals(c, [&](std::size_t k) { return h * c.contact[k] * c.engagement[k]; }),
                   intervals(c, [&](std::size_t k) { return h * c.contact[k]; })}};
  if (m.feed_viscous > 0.0) s.regressors.push_back(trapezoid(c, c.v));
  return s;
}

double window_sum(const double* phi, const double* values) {
  double sum = 0.0;
  for (int k = 0; k < kWindow; ++k) sum += phi[k] * values[k];
  return sum;
}

bool is_mostly_contact(const std::vector<double>& contact, std::size_t start) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kWindow; ++k) sum += contact[start + k];
  return sum > 0.5 * kWindow;
}

}  // namespace

const TestFunctions& test_functions() {
  static const TestFunctions functions = [] {
    TestFunctions f{};
    int row = 0;
    for (int band = 0; band < 5; ++band)
      for (int is_sine = 0; is_sine < (band == 0 ? 1 : 2); ++is_sine, ++row) {
        f.band[row] = band;
        for (int k = 0; k < kWindow; ++k) {
          const double place = 3.141592653589793 * (k + 0.5) / kWindow;
          const double wave = is_sine ? std::sin(6.0 * band * place) : std::cos(6.0 * band * place);
          f.phi[row][k] = std::pow(std::sin(place), 4) * wave;
        }
      }
    return f;
  }();
  return functions;
}

SampleColumns nominal_columns(const Columns& c, const Machine& m, Balance balance) {
  if (balance == kFeedForce) return feed_columns(c, m);
  if (balance == kSpindleTorque)
    return {increments(c, c.w), {trapezoid(c, c.i), trapezoid(c, c.w), contact_integral(c, m)}};
  return {increments(c, c.i),
          {intervals(c, [&](std::size_t k) { return c.sample_s * c.voltage[k]; }), trapezoid(c, c.i),
           trapezoid(c, c.w)}};
}

BalanceRows windowed(const SampleColumns& samples, const std::vector<double>& contact) {
  const TestFunctions& f = test_functions();
  const std::size_t hop = kWindow / 2, count = samples.increment.size();
  const auto windows = static_cast<Eigen::Index>(count < kWindow ? 0 : (count - kWindow) / hop + 1);
  const auto width = static_cast<Eigen::Index>(samples.regressors.size());
  BalanceRows rows{Eigen::MatrixXd(windows * 9, width), Eigen::VectorXd(windows * 9), {}};
  for (Eigen::Index window = 0; window < windows; ++window) {
    const std::size_t start = static_cast<std::size_t>(window) * hop;
    const int state = is_mostly_contact(contact, start) ? 5 : 0;
    for (int j = 0; j < 9; ++j) {
      const Eigen::Index row = window * 9 + j;
      rows.y(row) = window_sum(f.phi[j].data(), samples.increment.data() + start);
      for (Eigen::Index p = 0; p < width; ++p)
        rows.x(row, p) =
            window_sum(f.phi[j].data(), samples.regressors[static_cast<std::size_t>(p)].data() + start);
      rows.group.push_back(f.band[j] + state);
    }
  }
  return rows;
}

}  // namespace blind
