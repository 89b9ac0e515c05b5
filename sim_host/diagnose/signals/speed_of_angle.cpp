#include "sim_host/diagnose/signals/speed_of_angle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "sim_host/diagnose/signals/shown_noise.hpp"

namespace morepro::host {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The angle without jumps; none where it does not turn, or too fast to be followed.
std::optional<std::vector<double>> followed(const std::vector<float>& angle, bool is_within_turn) {
  constexpr double kFastest = 0.4 * kTurn;  // per row
  std::vector<double> place;
  bool has_turned = false;
  for (std::size_t row = 0; row < angle.size(); ++row) {
    const auto now = static_cast<double>(angle[row]);
    if (row == 0 || std::isnan(place.back()) || std::isnan(now)) {
      place.push_back(now);
      continue;
    }
    const double change = now - static_cast<double>(angle[row - 1]);
    const double turned = is_within_turn ? std::remainder(change, kTurn) : change;
    if (is_within_turn && std::fabs(turned) > kFastest) return std::nullopt;
    has_turned |= turned != 0.0;
    place.push_back(place.back() + turned);
  }
  if (!has_turned) return std::nullopt;
  return place;
}

/// Of one sample: as stated, or as it shows where nothing is; a float's rounding, too.
double variance_of(const RecordingSignals& signals, const SensorNoise& stated, double farthest_rad) {
  const auto& angle = signals.value[index_of(Channel::kSpindleAngle)];
  const double step = step_of(angle);
  const double shown = std::max(white_noise_of(angle, 2), step / std::sqrt(12.0));
  const double own = stated.variance() > 0.0 ? std::sqrt(stated.variance()) : shown;
  const double rounding = farthest_rad * static_cast<double>(std::numeric_limits<float>::epsilon());
  return own * own + rounding * rounding / 12.0;
}

}  // namespace

bool take_speed_from_angle(RecordingSignals& signals, Sensors& sensors) {
  if (signals.has(Channel::kSpindleSpeed) || !signals.has(Channel::kSpindleAngle)) return false;
  const double farthest_rad = signals.largest(Channel::kSpindleAngle);
  const auto place = followed(signals.value[index_of(Channel::kSpindleAngle)], farthest_rad < 1.01 * kTurn);
  if (!place) return false;
  std::vector<float> speed(signals.rows, std::numeric_limits<float>::quiet_NaN());
  std::size_t known = 0;
  for (std::size_t row = 1; row + 1 < signals.rows; ++row) {
    if (std::isnan((*place)[row])) continue;
    speed[row] = static_cast<float>(0.5 * signals.rate_hz * ((*place)[row + 1] - (*place)[row - 1]));
    if (!std::isnan(speed[row])) ++known;
  }
  if (2 * known < signals.rows) return false;
  signals.value[index_of(Channel::kSpindleSpeed)] = std::move(speed);
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kSpindleSpeed));
  signals.has_speed_of_angle = true;
  // Two samples' noise and rounding over two intervals.
  const double variance = variance_of(signals, sensors[Channel::kSpindleAngle], farthest_rad);
  sensors[Channel::kSpindleSpeed] = {.noise = signals.rate_hz * std::sqrt(0.5 * variance), .lsb = 0.0};
  return true;
}

}  // namespace morepro::host
