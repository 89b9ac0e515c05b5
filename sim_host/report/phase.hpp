#pragma once
#include <cmath>
#include <cstdint>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// What the machine does, as far as its recording tells. A later one outweighs an earlier one where both fall
/// into one bucket of a chart. That the tool was changed is told from what came before and after.
enum class Phase : std::uint8_t { kIdle = 0, kAirCut = 1, kCut = 2 };

/// Tells the phase of every frame: contact where it is recorded, else whether the spindle turns; of a feed
/// axis alone whether it moves. A missing sample leaves what was.
class PhaseWatch {
 public:
  explicit PhaseWatch(const Sensors& sensors)
      : spindle_limit_rad_s_(
            std::fmax(kDeviations * deviation(sensors, Channel::kSpindleSpeed), kTurningRadS)),
        feed_limit_m_s_(std::fmax(kDeviations * deviation(sensors, Channel::kFeedSpeed), kMovingMS)) {}

  /// Anything that phases can be told from?
  static bool can_tell(std::uint16_t recorded) {
    return (recorded &
            (bit_of(Channel::kContact) | bit_of(Channel::kSpindleSpeed) | bit_of(Channel::kFeedSpeed))) != 0;
  }

  Phase step(const SensorFrame& frame) {
    if (frame.has(Channel::kContact)) in_contact_ = frame.get(Channel::kContact) > 0.5F;
    if (frame.has(Channel::kSpindleSpeed)) {
      has_spindle_ = true;
      is_moving_ = std::fabs(static_cast<double>(frame.get(Channel::kSpindleSpeed))) > spindle_limit_rad_s_;
    } else if (!has_spindle_ && frame.has(Channel::kFeedSpeed)) {
      is_moving_ = std::fabs(static_cast<double>(frame.get(Channel::kFeedSpeed))) > feed_limit_m_s_;
    }
    if (in_contact_) return Phase::kCut;
    return is_moving_ ? Phase::kAirCut : Phase::kIdle;
  }

 private:
  static constexpr double kDeviations = 5.0;   // noise hardly ever looks like motion
  static constexpr double kTurningRadS = 1.0;  // ten revolutions per minute cut nothing
  static constexpr double kMovingMS = 1.0e-4;

  static double deviation(const Sensors& sensors, Channel channel) {
    return std::sqrt(sensors[channel].variance());
  }

  double spindle_limit_rad_s_;
  double feed_limit_m_s_;
  bool in_contact_ = false;
  bool is_moving_ = false;
  bool has_spindle_ = false;
};

}  // namespace morepro::host
