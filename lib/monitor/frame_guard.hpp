#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/frame/channel.hpp"
#include "lib/frame/frame_flag.hpp"
#include "lib/frame/frame_view.hpp"
#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/stuck_detector.hpp"

namespace morepro {

/// What the guard makes of one frame.
struct GuardedFrame {
  FrameView frame;  ///< without the channels that must not be used
  bool is_accepted = false;
  bool is_restart = false;     ///< the gap before it is too long to predict: the state starts again
  std::uint32_t periods = 0;   ///< sampling periods since the last accepted frame; 0 for the first one
  std::uint32_t missing = 0;   ///< frames that were lost before this one
  std::uint16_t flags = 0;     ///< FrameFlag bits
  std::uint16_t rejected = 0;  ///< bit_of(channel)
};

/// Stands before the estimators: order and time of the frames, and values that no sensor can give. Nothing
/// that is not a finite number in its channel's range gets past it. Bounded time; may run in an interrupt.
class FrameGuard {
 public:
  /// The longest gap, in sampling periods, that is predicted through; it bounds the time of one step.
  static constexpr std::uint32_t kLongestGap = 4;

  /// `rate_hz` in 100 .. 20000.
  explicit FrameGuard(double rate_hz) : period_us_(static_cast<float>(1.0e6 / rate_hz)) {}

  GuardedFrame check(const SensorFrame& frame) {
    GuardedFrame result{.frame = {frame, frame.present}};
    if (!has_last_)
      accept_first(result);
    else if (!is_in_order(result))
      return result;
    else
      measure_gap(result);
    result.is_accepted = true;
    check_values(result);
    check_stuck(result);
    check_temperature(result);
    has_last_ = true;
    last_sequence_ = frame.sequence;
    last_time_us_ = frame.time_us;
    frames_behind_ = 0;
    return result;
  }

 private:
  /// So many frames in a row from the past are no stragglers: the sender started again.
  static constexpr std::uint32_t kSenderRestarted = 20;

  static void accept_first(GuardedFrame& result) { result.is_restart = true; }

  bool is_in_order(GuardedFrame& result) {
    const auto ahead = static_cast<std::int32_t>(result.frame.frame.sequence - last_sequence_);
    const auto later_us = static_cast<std::int32_t>(result.frame.frame.time_us - last_time_us_);
    if (ahead == 0) return refuse(result, FrameFlag::kDuplicate);
    if (ahead > 0 && later_us > 0) return true;
    if (++frames_behind_ < kSenderRestarted) return refuse(result, FrameFlag::kOld);
    result.flags = static_cast<std::uint16_t>(result.flags | bits_of(FrameFlag::kSequenceReset));
    result.is_restart = true;
    return true;
  }

  static bool refuse(GuardedFrame& result, FrameFlag flag) {
    result.flags = static_cast<std::uint16_t>(result.flags | bits_of(flag));
    return false;
  }

  void measure_gap(GuardedFrame& result) const {
    if (result.is_restart) return;
    const float elapsed = static_cast<float>(result.frame.frame.time_us - last_time_us_) / period_us_;
    const std::uint32_t by_sequence = result.frame.frame.sequence - last_sequence_;
    const auto by_time = elapsed < 1.0e6F ? static_cast<std::uint32_t>(elapsed + 0.5F) : 1000000U;
    result.periods = by_time > 0 ? by_time : 1;
    result.missing = (by_sequence > result.periods ? by_sequence : result.periods) - 1;
    result.is_restart = result.periods > kLongestGap;
    if (result.is_restart) mark(result, FrameFlag::kTimeJump);
    if (by_time == 0 || by_sequence > result.periods) mark(result, FrameFlag::kTimeJump);
    if (result.missing > 0) mark(result, FrameFlag::kMissingBefore);
  }

  static void mark(GuardedFrame& result, FrameFlag flag) {
    result.flags = static_cast<std::uint16_t>(result.flags | bits_of(flag));
  }

  static void drop(GuardedFrame& result, std::size_t index, FrameFlag flag) {
    const auto bit = static_cast<std::uint16_t>(1U << index);
    result.frame.usable = static_cast<std::uint16_t>(result.frame.usable & ~bit);
    result.rejected = static_cast<std::uint16_t>(result.rejected | bit);
    mark(result, flag);
  }

  static void check_values(GuardedFrame& result) {
    result.frame.for_each([&result](std::size_t i, float value) {
      if (value >= kChannels[i].lowest && value <= kChannels[i].highest) return;
      const bool is_number = value - value == 0.0F;
      drop(result, i, is_number ? FrameFlag::kOutOfRange : FrameFlag::kNotFinite);
    });
  }

  /// No tool gets hotter or colder by so much within some frames: a thermocouple broke. Out of the cut, where
  /// tools are changed, a new level is believed after a while.
  static constexpr float kLargestJump_degc = 100.0F;
  static constexpr std::uint32_t kNewLevel = 1000;

  void check_temperature(GuardedFrame& result) {
    if (!result.frame.has(Channel::kToolTemperature)) return;
    const float temperature_degc = result.frame.get(Channel::kToolTemperature);
    const float jump = temperature_degc - last_temperature_degc_;
    const bool jumps = jump > kLargestJump_degc || jump < -kLargestJump_degc;
    const bool cuts = result.frame.has(Channel::kContact) && result.frame.get(Channel::kContact) > 0.5F;
    jumped_in_air_ = jumps && !cuts ? jumped_in_air_ + 1 : 0;
    if (has_temperature_ && jumps && !result.is_restart && jumped_in_air_ < kNewLevel)
      return drop(result, index_of(Channel::kToolTemperature), FrameFlag::kJump);
    has_temperature_ = true;
    last_temperature_degc_ = temperature_degc;
  }

  /// A machine without drive that reads exactly zero stands still; that is no fault.
  void check_stuck(GuardedFrame& result) {
    for (std::size_t k = 0; k < kWatched.size(); ++k) {
      const auto [sensor, drive] = kWatched[k];
      if (!result.frame.has(sensor)) continue;
      const float value = result.frame.get(sensor);
      const bool stands_still = value == 0.0F && result.frame.get(drive) == 0.0F;
      if (stuck_[k].step(value) && !stands_still) drop(result, index_of(sensor), FrameFlag::kStuck);
    }
  }

  /// Sensors whose noise never rests while they live, and the input that moves what they measure.
  struct Watched {
    Channel sensor;
    Channel drive;
  };
  static constexpr std::array<Watched, 4> kWatched{{{Channel::kSpindleSpeed, Channel::kArmatureVoltage},
                                                    {Channel::kArmatureCurrent, Channel::kArmatureVoltage},
                                                    {Channel::kFeedSpeed, Channel::kFeedForce},
                                                    {Channel::kFeedPosition, Channel::kFeedForce}}};

  float period_us_;
  bool has_last_ = false;
  bool has_temperature_ = false;
  float last_temperature_degc_ = 0.0F;
  std::uint32_t jumped_in_air_ = 0;
  std::uint32_t last_sequence_ = 0;
  std::uint32_t last_time_us_ = 0;
  std::uint32_t frames_behind_ = 0;
  std::array<StuckDetector, kWatched.size()> stuck_{};
};

}  // namespace morepro
