#pragma once
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro {

/// Of all frames; a link that loses less than that is a good one.
inline constexpr float kLeastLostShare = 5.0e-4F;

/// What of the samples of these sensors is no fault. A sensor that the machine does not have is not watched.
inline gap::SampleLimits sample_limits_of(const Sensors& sensors) {
  return {.speed_step_rad_s = sensors[Channel::kSpindleSpeed].coarsest_step(),
          .current_step_a = sensors[Channel::kArmatureCurrent].coarsest_step(),
          .feed_step_m_s = sensors[Channel::kFeedSpeed].coarsest_step(),
          .position_step_m = sensors[Channel::kFeedPosition].coarsest_step(),
          .lost_share = kLeastLostShare};
}

}  // namespace morepro
