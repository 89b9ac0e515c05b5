#pragma once
#include <array>
#include <cstdint>

#include "lib/frame/channel.hpp"
#include "lib/frame/frame_flag.hpp"
#include "lib/monitor/reason.hpp"

namespace morepro {

/// Notices a sensor that was there and is not usable any more, whatever the cause. A channel that was never
/// recorded is no fault: its part is not evaluated.
class SensorWatch {
 public:
  /// Frames without a usable value after which a sensor counts as failed, and usable ones after which it is
  /// back.
  static constexpr std::uint32_t kPatience = 50;

  /// `usable`: bit_of(channel) of this frame's usable values; `flags`: the frame's FrameFlag bits.
  void step(std::uint16_t usable, std::uint16_t rejected, std::uint16_t flags) {
    for (std::size_t k = 0; k < kWatched.size(); ++k) {
      auto& sensor = sensors_[k];
      const std::uint16_t bit = bit_of(kWatched[k]);
      if ((usable & bit) != 0)
        sensor.heal();
      else if (sensor.was_seen)
        sensor.fail((rejected & bit) != 0 ? cause_of(flags) : ReasonCode::kSensorMissing);
    }
  }

  /// kNone: every sensor that was seen works.
  [[nodiscard]] ReasonCode fault() const {
    for (const auto& sensor : sensors_) {
      if (sensor.has_failed) return sensor.cause;
    }
    return ReasonCode::kNone;
  }

 private:
  struct Sensor {
    bool was_seen = false;
    bool has_failed = false;
    std::uint32_t frames = 0;
    ReasonCode cause = ReasonCode::kNone;

    void heal() {
      was_seen = true;
      frames = has_failed && frames > 0 ? frames - 1 : 0;
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

  static constexpr std::array<Channel, 6> kWatched{Channel::kArmatureVoltage, Channel::kFeedForce,
                                                   Channel::kSpindleSpeed,    Channel::kArmatureCurrent,
                                                   Channel::kFeedSpeed,       Channel::kFeedPosition};
  std::array<Sensor, kWatched.size()> sensors_{};
};

}  // namespace morepro
