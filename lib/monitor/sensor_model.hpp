#pragma once
#include "lib/estimation/feed_filter.hpp"
#include "lib/estimation/spindle_signals.hpp"
#include "lib/frame/frame_view.hpp"
#include "lib/monitor/measurement_variance.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro {

/// Turns the usable channels of a frame into what the filters measure, each with its variance.
class SensorModel {
 public:
  explicit SensorModel(const MonitorConfiguration& c)
      : speed_(measurement_variance(c, Channel::kSpindleSpeed)),
        current_(measurement_variance(c, Channel::kArmatureCurrent)),
        feed_speed_(measurement_variance(c, Channel::kFeedSpeed)),
        position_(measurement_variance(c, Channel::kFeedPosition)) {}

  [[nodiscard]] SpindleMeasurement<float> spindle(const FrameView& frame) const {
    return {value(frame, Channel::kSpindleSpeed), value(frame, Channel::kArmatureCurrent),
            variance(frame, Channel::kSpindleSpeed, speed_),
            variance(frame, Channel::kArmatureCurrent, current_)};
  }

  [[nodiscard]] FeedMeasurement<float> feed(const FrameView& frame) const {
    return {value(frame, Channel::kFeedSpeed), value(frame, Channel::kFeedPosition),
            variance(frame, Channel::kFeedSpeed, feed_speed_),
            variance(frame, Channel::kFeedPosition, position_)};
  }

 private:
  static float value(const FrameView& frame, Channel channel) {
    return frame.has(channel) ? frame.get(channel) : 0.0F;
  }
  static float variance(const FrameView& frame, Channel channel, float measured) {
    return frame.has(channel) ? measured : kUnmeasured;
  }

  float speed_, current_, feed_speed_, position_;
};

}  // namespace morepro
