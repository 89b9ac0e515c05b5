#include "sim_host/diagnose/signals/differenced_speed.hpp"

#include <cmath>

namespace morepro::host {
namespace {

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
