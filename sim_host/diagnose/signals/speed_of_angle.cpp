#include "sim_host/diagnose/signals/speed_of_angle.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace morepro::host {

bool take_speed_from_angle(RecordingSignals& signals, Sensors& sensors) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (signals.has(Channel::kSpindleSpeed) || !signals.has(Channel::kSpindleAngle)) return false;
  const auto& angle = signals.value[index_of(Channel::kSpindleAngle)];
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  speed.assign(signals.rows, std::numeric_limits<float>::quiet_NaN());
  double farthest_rad = 0.0;
  for (std::size_t row = 1; row + 1 < signals.rows; ++row) {
    const double turned = static_cast<double>(angle[row + 1]) - static_cast<double>(angle[row - 1]);
    speed[row] = static_cast<float>(0.5 * signals.rate_hz * std::remainder(turned, kTurn));
    farthest_rad = std::fmax(farthest_rad, std::fabs(static_cast<double>(angle[row])));
  }
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kSpindleSpeed));
  // Two samples' noise and rounding, a float's too, over two intervals.
  const double rounding = farthest_rad * static_cast<double>(std::numeric_limits<float>::epsilon());
  const double variance = sensors[Channel::kSpindleAngle].variance() + rounding * rounding / 12.0;
  sensors[Channel::kSpindleSpeed] = {.noise = signals.rate_hz * std::sqrt(0.5 * variance), .lsb = 0.0};
  return true;
}

}  // namespace morepro::host
