#pragma once
#include "lib/frame/channel.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro {

/// Variance with which a channel's samples are used: the sensor's own, but not below that of one step's
/// process noise. A sensor whose noise was not stated is not perfect.
inline float measurement_variance(const MonitorConfiguration& c, Channel channel) {
  const double period_s = 1.0 / c.sampling.rate_hz;
  double floor = 0.0;
  if (channel == Channel::kSpindleSpeed) floor = c.tuning.speed_process_noise_rad_s;
  if (channel == Channel::kArmatureCurrent) floor = c.tuning.current_process_noise_a;
  if (channel == Channel::kFeedSpeed) floor = c.tuning.feed_process_noise_m_s;
  if (channel == Channel::kFeedPosition) floor = c.tuning.feed_process_noise_m_s * period_s;
  const double variance = c.sensors[channel].variance();
  return static_cast<float>(variance > floor * floor ? variance : floor * floor);
}

}  // namespace morepro
