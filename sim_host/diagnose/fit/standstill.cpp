#include "sim_host/diagnose/fit/standstill.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace morepro::host {
namespace {

/// Sums over blocks so long that the sensor's noise is no motion.
std::vector<double> calm_speed(const std::vector<float>& speed, double rate_hz) {
  constexpr double kCalmS = 0.01;
  const auto length = static_cast<std::size_t>(std::max(kCalmS * rate_hz, 1.0));
  std::vector<double> sums;
  for (std::size_t first = 0; first + length <= speed.size(); first += length) {
    double sum = 0.0;
    for (std::size_t row = first; row < first + length; ++row)
      if (!std::isnan(speed[row])) sum += static_cast<double>(speed[row]);
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

bool passes_standstill_seldom(const RecordingSignals& signals) {
  constexpr int kOften = 8;         // a quarter shows two
  constexpr double kMoving = 0.2;   // of the fastest
  constexpr double kResting = 0.1;  // of it: between them it may be either
  const std::vector<double> speed = calm_speed(signals.value[index_of(Channel::kFeedSpeed)], signals.rate_hz);
  double fastest = 0.0;
  for (const double value : speed) fastest = std::max(fastest, std::fabs(value));
  int moves = 0;
  double way = 0.0;  // 0 at rest
  for (const double value : speed) {
    if (std::fabs(value) < kResting * fastest) way = 0.0;
    if (!(std::fabs(value) > kMoving * fastest) || value * way > 0.0) continue;
    ++moves;
    way = value;
  }
  return moves > 1 && moves <= kOften;
}

}  // namespace morepro::host
