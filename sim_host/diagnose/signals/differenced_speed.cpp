#include "sim_host/diagnose/signals/differenced_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace morepro::host {
namespace {

double bend(const std::vector<double>& values, std::size_t i) {
  return values[i] - 2.0 * values[i - 1] + values[i - 2];
}

/// Share of what is fast in a position's differences that a speed does not repeat, as a mean square. What is
/// fast is noise and rounding, of which a sensor of its own shows nothing. `ahead`, `behind`: rows that the
/// difference is taken over.
double share_of_its_own(const RecordingSignals& signals, std::size_t behind, std::size_t ahead) {
  const auto& position = signals.value[index_of(Channel::kFeedPosition)];
  const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  const double per_s = signals.rate_hz / static_cast<double>(behind + ahead);
  std::vector<double> difference;
  std::vector<double> own;
  // At the ends nobody knows what was shown.
  for (std::size_t row = 2; row + 2 < signals.rows; ++row) {
    difference.push_back(
        per_s * (static_cast<double>(position[row + ahead]) - static_cast<double>(position[row - behind])));
    own.push_back(static_cast<double>(speed[row]) - difference.back());
  }
  double of_difference = 0.0;
  double of_own = 0.0;
  for (std::size_t i = 2; i < own.size(); ++i) {
    const double fast = bend(difference, i);
    const double left = bend(own, i);
    if (!std::isfinite(fast) || !std::isfinite(left)) continue;
    of_difference += fast * fast;
    of_own += left * left;
  }
  return of_difference > 0.0 ? of_own / of_difference : 1.0;
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

bool leave_out_derived_speed(RecordingSignals& signals) {
  constexpr double kNothing = 0.01;
  if (!signals.has(Channel::kFeedPosition) || !signals.has(Channel::kFeedSpeed)) return false;
  const double own = std::min(
      {share_of_its_own(signals, 1, 0), share_of_its_own(signals, 0, 1), share_of_its_own(signals, 1, 1)});
  if (!(own < kNothing)) return false;
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
