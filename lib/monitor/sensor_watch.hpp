#pragma once
#include <array>
#include <cstdint>

#include "lib/frame/channel.hpp"
#include "lib/frame/frame_flag.hpp"
#include "lib/monitor/reason.hpp"

namespace morepro {

/// Notices a channel that was there and is not usable any more, whatever the cause. A channel that was never
/// recorded is no fault: its part is not evaluated. Every unusable frame counts up, every usable one down, so
/// that a sensor that gives a value now and then does not pass for one that works.
class SensorWatch {
 public:
  /// Unusable frames, less usable ones, from which on a channel counts as failed; it is back at none.
  static constexpr std::uint32_t kPatience = 20;
  /// So many leave room for a spike, no more: what is estimated meanwhile is not certain.
  static constexpr std::uint32_t kFresh = 5;

  /// `usable`: bit_of(channel) of this frame's usable values; `flags`: the frame's FrameFlag bits.
  void step(std::uint16_t usable, std::uint16_t rejected, std::uint16_t flags) {
    is_fresh_ = true;
    fault_ = ReasonCode::kNone;
    for (std::size_t k = 0; k < kWatched.size(); ++k) {
      auto& sensor = sensors_[k];
      const std::uint16_t bit = bit_of(kWatched[k]);
      if ((usable & bit) != 0)
        sensor.heal();
      else if (sensor.was_seen)
        sensor.fail((rejected & bit) != 0 ? cause_of(flags) : ReasonCode::kSensorMissing);
      if (sensor.frames >= kFresh) is_fresh_ = false;
      if (sensor.has_failed && fault_ == ReasonCode::kNone) fault_ = sensor.cause;
    }
  }

  /// kNone: every channel that was seen works.
  [[nodiscard]] ReasonCode fault() const { return fault_; }
  /// Every channel that was seen has given a value within the last few frames.
  [[nodiscard]] bool is_fresh() const { return is_fresh_; }

 private:
  struct Sensor {
    bool was_seen = false;
    bool has_failed = false;
    std::uint32_t frames = 0;
    ReasonCode cause = ReasonCode::kNone;

    void heal() {
      was_seen = true;
      if (frames > 0) --frames;
      if (frames == 0) has_failed = false;
    }
    void fail(ReasonCode why) {
      if (frames < kPatience) ++frames;
      cause = why;
      if (frames >= kPatience) has_failed = true;
    }
  };

  static ReasonCode cause_of(std::uint16_t flags) {
    if ((flags & bits_of(FrameFlag::kStuck)) != 0) return ReasonCode::kSensorStuck;
    if ((flags & bits_of(FrameFlag::kNotFinite)) != 0) return ReasonCode::kSensorNotFinite;
    if ((flags & bits_of(FrameFlag::kOutOfRange)) != 0) return ReasonCode::kSensorOutOfRange;
    return ReasonCode::kSensorJump;
  }

  /// What a verdict or an estimate rests on.
  static constexpr std::array<Channel, 10> kWatched{
      Channel::kArmatureVoltage, Channel::kFeedForce,       Channel::kContact,   Channel::kEngagement,
      Channel::kSpindleSpeed,    Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition,
      Channel::kToolTemperature, Channel::kChipLoad};
  std::array<Sensor, kWatched.size()> sensors_{};
  ReasonCode fault_ = ReasonCode::kNone;
  bool is_fresh_ = true;
};

}  // namespace morepro
