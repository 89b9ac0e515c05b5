#include "sim_host/diagnose/signals/differenced_speed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "sim_host/diagnose/signals/written_digits.hpp"

namespace morepro::host {
namespace {

/// Rows that a difference of the position is taken over.
struct Span {
  std::size_t behind = 1;
  std::size_t ahead = 0;
};

/// In m/s.
double difference_at(const RecordingSignals& signals, Span span, std::size_t row) {
  const auto& position = signals.value[index_of(Channel::kFeedPosition)];
  const double per_s = signals.rate_hz / static_cast<double>(span.behind + span.ahead);
  return per_s *
         (static_cast<double>(position[row + span.ahead]) - static_cast<double>(position[row - span.behind]));
}

/// How a speed differs from a difference of the position, in m/s.
struct OwnOfSpeed {
  double share = 1.0;  ///< of what is fast in the difference, noise and rounding, as a mean square
  double rms = 0.0;
};

OwnOfSpeed own_of_speed(const RecordingSignals& signals, Span span) {
  const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  double of_difference = 0.0, of_own = 0.0, squares = 0.0, count = 0.0;
  std::array<double, 3> difference{};
  std::array<double, 3> own{};
  const auto bend = [](const std::array<double, 3>& last) { return last[0] - 2.0 * last[1] + last[2]; };
  // At the ends nobody knows what was shown.
  const std::size_t first = std::max<std::size_t>(span.behind, 2);
  for (std::size_t row = first; row + std::max<std::size_t>(span.ahead, 2) < signals.rows; ++row) {
    const double now = difference_at(signals, span, row);
    difference = {now, difference[0], difference[1]};
    own = {static_cast<double>(speed[row]) - now, own[0], own[1]};
    if (row < first + 2 || !std::isfinite(bend(difference)) || !std::isfinite(bend(own))) continue;
    of_difference += bend(difference) * bend(difference);
    of_own += bend(own) * bend(own);
    squares += own[0] * own[0];
    count += 1.0;
  }
  if (!(of_difference > 0.0)) return {};
  return {.share = of_own / of_difference, .rms = std::sqrt(squares / count)};
}

/// The one, beyond the neighbouring rows, that the speed is nearest to in a few thousand rows.
Span nearest_long_span(const RecordingSignals& signals) {
  constexpr std::size_t kLongest = 20, kLooks = 4000;
  const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  const std::size_t apart = std::max<std::size_t>(1, signals.rows / kLooks);
  Span nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](Span span) {
    double squares = 0.0, count = 0.0;
    for (std::size_t row = kLongest; row + kLongest < signals.rows; row += apart) {
      const double own = static_cast<double>(speed[row]) - difference_at(signals, span, row);
      if (!std::isfinite(own)) continue;
      squares += own * own;
      count += 1.0;
    }
    if (squares < least * count) {
      least = squares / count;
      nearest = span;
    }
  };
  for (std::size_t rows = 2; rows <= kLongest; ++rows) {
    look_at({.behind = rows, .ahead = 0});
    look_at({.behind = rows, .ahead = rows});
  }
  return nearest;
}

OwnOfSpeed least_own_of_speed(const RecordingSignals& signals) {
  if (!signals.has(Channel::kFeedPosition) || !signals.has(Channel::kFeedSpeed)) return {};
  const auto own = [&signals](Span span) { return own_of_speed(signals, span); };
  const auto by_share = [](const OwnOfSpeed& one) { return one.share; };
  return std::ranges::min({own({1, 0}), own({0, 1}), own({1, 1}), own(nearest_long_span(signals))}, {},
                          by_share);
}

/// What rounding makes of a difference of the position, in m/s: as it was written, and as floats hold it.
double rounding_of_speed(const RecordingSignals& signals) {
  constexpr double kOfStep = 0.35;  // 0.29 of uniform rounding
  constexpr double kOfDigits = 1.0e-6;
  const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  const double steps = std::max(step_of(speed), written_step_of(speed));
  const double of_floats = signals.rate_hz * signals.largest(Channel::kFeedPosition) *
                           static_cast<double>(std::numeric_limits<float>::epsilon());
  return std::max({kOfStep * steps, kOfDigits * signals.largest(Channel::kFeedSpeed), of_floats});
}

/// Mean square of second differences where the sensor shows something, over that of white noise of one:
/// its variance, because motion hardly bends within three samples.
double fast_variance(const std::vector<float>& column) {
  constexpr double kOfWhiteNoise = 6.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 2; i < column.size(); ++i) {
    const double bend = static_cast<double>(column[i]) - 2.0 * static_cast<double>(column[i - 1]) +
                        static_cast<double>(column[i - 2]);
    if (!std::isfinite(bend) || column[i - 1] == 0.0F) continue;
    squares += bend * bend;
    count += 1.0;
  }
  return count > 0.0 ? squares / (kOfWhiteNoise * count) : 0.0;
}

/// Neighbouring differences share a rounding with opposite signs: their second differences have 20/12 of a
/// squared step, 0.28 of it as a variance, 0.19 where an axis mostly moves at round speeds. A rounded speed
/// has 1/12 of it and its noise's, 0.15 with the most noise that leaves steps to be seen.
bool is_difference(const std::vector<float>& column, const SensorNoise& sensor) {
  constexpr double kMostNoise = 0.25;  // steps
  constexpr double kVariance = 0.17;   // squared steps
  return sensor.lsb > 0.0 && sensor.noise < kMostNoise * sensor.lsb &&
         fast_variance(column) > kVariance * sensor.lsb * sensor.lsb;
}

}  // namespace

bool is_speed_of_position(const RecordingSignals& signals) { return least_own_of_speed(signals).share < 0.5; }

bool leave_out_derived_speed(RecordingSignals& signals) {
  constexpr double kNothing = 0.01;
  const OwnOfSpeed own = least_own_of_speed(signals);
  if (!(own.share < kNothing) || own.rms > rounding_of_speed(signals)) return false;
  signals.value[index_of(Channel::kFeedSpeed)].clear();
  signals.recorded = static_cast<std::uint16_t>(signals.recorded & ~bit_of(Channel::kFeedSpeed));
  return true;
}

std::vector<Channel> allow_for_differences(const RecordingSignals& signals, Sensors& sensors) {
  std::vector<Channel> found;
  for (const Channel channel : {Channel::kSpindleSpeed, Channel::kFeedSpeed}) {
    SensorNoise& sensor = sensors[channel];
    if (!is_difference(signals.value[index_of(channel)], sensor)) continue;
    sensor.noise = std::sqrt(sensor.variance());
    found.push_back(channel);
  }
  return found;
}

}  // namespace morepro::host
