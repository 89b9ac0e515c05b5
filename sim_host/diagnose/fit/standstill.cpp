#include "sim_host/diagnose/fit/standstill.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace morepro::host {
namespace {

constexpr std::size_t kOften = 8;  // a quarter of the recording shows two

/// Rows of a block so long that the noise of a speed's mean is no motion.
std::size_t rows_of_block(double rate_hz) {
  constexpr double kCalmS = 0.01;
  return static_cast<std::size_t>(std::max(kCalmS * rate_hz, 1.0));
}

/// Means over blocks; the one before where half of a block was lost.
std::vector<double> calm_speed(const std::vector<float>& speed, std::size_t length) {
  std::vector<double> means;
  for (std::size_t first = 0; first + length <= speed.size(); first += length) {
    double sum = 0.0, count = 0.0;
    for (std::size_t row = first; row < first + length; ++row) {
      if (std::isnan(speed[row])) continue;
      sum += static_cast<double>(speed[row]);
      count += 1.0;
    }
    const double before = means.empty() ? 0.0 : means.back();
    means.push_back(2.0 * count > static_cast<double>(length) ? sum / count : before);
  }
  return means;
}

/// Rows in which a motion the other way, or after a rest, begins; 0 where one is under way at first.
std::vector<std::size_t> moves_of(const RecordingSignals& signals) {
  constexpr double kMoving = 0.2;   // of the fastest
  constexpr double kResting = 0.1;  // of it: between them it may be either
  const std::size_t length = rows_of_block(signals.rate_hz);
  const std::vector<double> speed = calm_speed(signals.value[index_of(Channel::kFeedSpeed)], length);
  double fastest = 0.0;
  for (const double value : speed) fastest = std::max(fastest, std::fabs(value));
  std::vector<std::size_t> moves;
  std::size_t rested = 0;
  double way = 0.0;  // 0 at rest
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (std::fabs(speed[i]) < kResting * fastest) {
      way = 0.0;
      rested = i;
    }
    if (!(std::fabs(speed[i]) > kMoving * fastest) || speed[i] * way > 0.0) continue;
    moves.push_back((way == 0.0 ? rested : i) * length);
    way = speed[i];
  }
  return moves;
}

bool are_seldom(const std::vector<std::size_t>& moves) { return moves.size() <= kOften; }

/// The stretch, within `room`, moved to where its middle is the first of `moves` in it, or longer where there
/// are more than it holds.
Stretch around(std::span<const std::size_t> moves, Stretch stretch, Stretch room) {
  const std::size_t length = stretch.last - stretch.first;
  const auto is_in = [room](std::size_t row) { return row >= room.first && row < room.last; };
  std::size_t least = room.last, most = room.first;
  for (const std::size_t row : moves) {
    if (row == 0 || !is_in(row)) continue;
    least = std::min(least, row);
    most = std::max(most, row);
  }
  if (least > most) return stretch;
  const std::size_t before = std::min(length / 2, least - room.first);
  const std::size_t first = std::min(least - before, room.last - length);
  return {first, std::clamp(most + length / 2, first + length, room.last)};
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
  const std::vector<std::size_t> moves = moves_of(signals);
  return moves.size() > 1 && are_seldom(moves);
}

// A spindle that seldom stands still was seen as a whole once: an offset of 53 V stood in for crosstalk.
std::vector<Stretch> telling_quarter_of(Axis axis, const RecordingSignals& signals) {
  constexpr double kLastingS = 0.1;  // in 47 ms a slide that swings behind its play was random forces
  std::vector<Stretch> quarter = quarter_of(signals);
  if (axis == Axis::kSpindle || quarter.size() == 1) return quarter;
  const std::vector<std::size_t> moves = moves_of(signals);
  if (!are_seldom(moves)) return quarter;
  if (static_cast<double>(quarter.front().last - quarter.front().first) < kLastingS * signals.rate_hz)
    return all_of(signals);
  const std::size_t room = signals.rows / quarter.size();
  for (std::size_t i = 0; i < quarter.size(); ++i)
    quarter[i] = around(moves, quarter[i], {i * room, (i + 1) * room});
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
