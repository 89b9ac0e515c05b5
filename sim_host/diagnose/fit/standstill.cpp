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

constexpr std::size_t kOften = 8;  // a quarter of the recording shows two

/// Rows in which a motion the other way, or after a rest, begins.
std::vector<std::size_t> moves_of(const RecordingSignals& signals) {
  constexpr double kMoving = 0.2;   // of the fastest
  constexpr double kResting = 0.1;  // of it: between them it may be either
  const std::vector<double> speed = calm_speed(signals.value[index_of(Channel::kFeedSpeed)], signals.rate_hz);
  if (speed.empty()) return {};
  const std::size_t length = signals.rows / speed.size();
  double fastest = 0.0;
  for (const double value : speed) fastest = std::max(fastest, std::fabs(value));
  std::vector<std::size_t> moves;
  std::size_t rested = 0;
  double way = 0.0;  // 0 at rest
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (std::fabs(speed[i]) < kResting * fastest) way = 0.0, rested = i;
    if (!(std::fabs(speed[i]) > kMoving * fastest) || speed[i] * way > 0.0) continue;
    moves.push_back((way == 0.0 ? rested : i) * length);
    way = speed[i];
  }
  return moves;
}

/// Mean square of what was recorded, about its mean or about nothing.
double mean_square(const std::vector<float>& values, bool is_about_mean) {
  double count = 0.0, mean = 0.0, squares = 0.0;  // the sum of squares about the mean, after Welford
  for (const float value : values) {
    if (std::isnan(value)) continue;
    const double step = static_cast<double>(value) - mean;
    mean += step / ++count;
    squares += step * (static_cast<double>(value) - mean);
  }
  if (!(count > 0.0)) return 0.0;
  return squares / count + (is_about_mean ? 0.0 : mean * mean);
}

}  // namespace

bool passes_standstill_seldom(const RecordingSignals& signals) {
  const std::size_t moves = moves_of(signals).size();
  return moves > 1 && moves <= kOften;
}

std::vector<Stretch> telling_quarter_of(Axis axis, const RecordingSignals& signals) {
  std::vector<Stretch> quarter = quarter_of(signals);
  if (axis == Axis::kSpindle || quarter.size() == 1) return quarter;
  const std::vector<std::size_t> moves = moves_of(signals);
  if (moves.size() > kOften) return quarter;
  const std::size_t room = signals.rows / quarter.size();
  for (const std::size_t row : moves) {
    const std::size_t index = std::min(row / room, quarter.size() - 1);
    auto& [first, last] = quarter[index];
    const std::size_t length = last - first;
    const std::size_t least = index * room;
    first = std::clamp(row - std::min(row, length / 2), least, least + room - length);
    last = first + length;
  }
  return quarter;
}

bool stands_still(Axis axis, const RecordingSignals& signals, const gap::GapNoise<double>& noise) {
  constexpr double kMoving = 4.0;  // times the noise's variance
  // A controller's answer to its sensors' noise moves a position by some of its own; a stroke by thousands.
  constexpr double kOnItsWay = 1.0e4;
  const auto is_within = [&](Channel channel, double most, double variance) {
    const bool is_about_mean = channel == Channel::kFeedPosition;
    return mean_square(signals.value[index_of(channel)], is_about_mean) < most * variance;
  };
  if (axis == Axis::kSpindle) return is_within(Channel::kSpindleSpeed, kMoving, noise.speed_variance);
  if (!signals.has(Channel::kFeedSpeed))
    return is_within(Channel::kFeedPosition, kMoving, noise.feed_position_variance);
  return is_within(Channel::kFeedSpeed, kMoving, noise.feed_speed_variance) &&
         (!signals.has(Channel::kFeedPosition) ||
          is_within(Channel::kFeedPosition, kOnItsWay, noise.feed_position_variance));
}

}  // namespace morepro::host
