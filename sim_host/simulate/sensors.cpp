#include "sim_host/simulate/sensors.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {

SensorModel::SensorModel(const Sensors& sensors, std::uint64_t seed) : sensors_(sensors) {
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    noise_.emplace_back(mixed(seed, 100 + i));
    const bool is_sampled = info_of(channel).kind == ChannelKind::kSampled;
    if (is_sampled && sensors[channel].variance() > 0.0) {
      measured_ = static_cast<std::uint16_t>(measured_ | bit_of(channel));
    }
  }
}

double SensorModel::step_of(Channel channel) const {
  const SensorNoise& sensor = sensors_[channel];
  const bool is_affected = channel == Channel::kSpindleSpeed || channel == Channel::kFeedSpeed ||
                           channel == Channel::kArmatureCurrent;
  if (!is_affected) return sensor.lsb;
  return std::max(sensor.lsb, quantization_ * (sensor.lsb > 0.0 ? sensor.lsb : sensor.noise));
}

void SensorModel::measure(Channel channel, double truth, SensorFrame& frame) {
  if (!(measured_ & bit_of(channel))) return;
  const SensorNoise& sensor = sensors_[channel];
  double value = truth + sensor.noise * noise_[index_of(channel)].next();
  if (const double step = step_of(channel); step > 0.0) value = std::round(value / step) * step;
  frame.set(channel, static_cast<float>(value));
}

}  // namespace morepro::host
