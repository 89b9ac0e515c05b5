#include "sim_host/diagnose/balances/noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr double kSureOfFloor = 4.0;        // standard deviations
constexpr std::size_t kFewestWindows = 50;  // windows that tell
constexpr double kMedianOfSquare = 0.4549;  // of a standard normal variable
// A median of squares scatters 1.3 times as much about their mean as the mean itself about the truth.
constexpr double kMedianScatter = 1.3;
constexpr double kLeastFloorShare = 0.05;

std::complex<double> amplitude(const WindowResidual& window, std::size_t band) {
  if (band == 0) return window.row[0];
  return {window.row[2 * band - 1], window.row[2 * band]};
}

/// Two windows on, without a hole.
bool is_next(const WindowResidual& one, const WindowResidual& other) {
  return other.first - one.first == kWindowLength && other.in_contact == one.in_contact;
}

/// Share of the mean power that is the same, up to its phase, from one window to the next without a common
/// sample.
double lasting_share(std::span<const WindowResidual> windows, std::size_t band, bool contact, double mean) {
  std::complex<double> sum = 0.0;
  double pairs = 0.0;
  for (std::size_t i = 0; i + 2 < windows.size(); ++i) {
    if (windows[i].in_contact != contact || !is_next(windows[i], windows[i + 2])) continue;
    sum += amplitude(windows[i], band) * std::conj(amplitude(windows[i + 2], band));
    pairs += 1.0;
  }
  if (pairs < kFewestWindows) return 0.0;
  // What does not pass zero is no wave: without periods it has to keep its sign.
  const double kept = band == 0 ? sum.real() : std::abs(sum);
  const double share = kept / (pairs * mean * rows_of_band(band));
  return share > kSureOfFloor / std::sqrt(kOverlap * pairs) ? share : 0.0;
}

double share_of_band(std::span<const WindowResidual> windows, std::size_t band, bool contact) {
  std::vector<double> squares;
  double sum = 0.0;
  for (const WindowResidual& window : windows) {
    if (window.in_contact != contact) continue;
    for (std::size_t r = band == 0 ? 0 : 2 * band - 1; r <= 2 * band; ++r)
      squares.push_back(window.row[r] * window.row[r]);
    sum += std::norm(amplitude(window, band));
  }
  const auto rows = static_cast<double>(squares.size());
  if (!(rows >= static_cast<double>(kFewestWindows) * rows_of_band(band)) || !(sum > 0.0)) return 1.0;
  const double mean = sum / rows;
  const double usual = median_of(squares) / kMedianOfSquare;
  const double scatter = kMedianScatter * std::sqrt(2.0 / (kOverlap * rows));
  const double without_few = usual < mean * (1.0 - kSureOfFloor * scatter) ? usual / mean : 1.0;
  const double without_lasting = 1.0 - lasting_share(windows, band, contact, mean);
  return std::clamp(std::min(without_few, without_lasting), kLeastFloorShare, 1.0);
}

}  // namespace

NoiseShares noise_shares(const std::vector<WindowResidual>& windows) {
  NoiseShares shares{};
  for (std::size_t band = 0; band < kBands; ++band)
    for (const bool contact : {false, true}) shares[band][contact] = share_of_band(windows, band, contact);
  return shares;
}

}  // namespace morepro::host
