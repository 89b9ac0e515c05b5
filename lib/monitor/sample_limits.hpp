#pragma once
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro {

/// What of the samples of this machine is no fault. A sensor that it does not have is not watched.
inline gap::SampleLimits sample_limits_of(const MonitorConfiguration& c) {
  return {.speed_step_rad_s = c.sensors[Channel::kSpindleSpeed].coarsest_step(),
          .current_step_a = c.sensors[Channel::kArmatureCurrent].coarsest_step(),
          .feed_step_m_s = c.sensors[Channel::kFeedSpeed].coarsest_step(),
          .position_step_m = c.sensors[Channel::kFeedPosition].coarsest_step(),
          .lost_share = static_cast<float>(c.gap.lost_share),
          .clock_jitter_s = static_cast<float>(c.gap.clock_jitter_s)};
}

}  // namespace morepro
