#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lib/gap/effect.hpp"

namespace morepro::gap {

/// Where an effect acts: in a balance, in what the sensors show, or in when they are read.
enum class EffectGroup : std::uint8_t {
  kSpindleTorque = 0,
  kFeedForce,
  kArmatureVoltage,
  kSensor,
  kSampling
};

inline constexpr std::array<std::string_view, 5> kEffectGroupNames{"spindle_torque", "feed_force",
                                                                   "armature_voltage", "sensor", "sampling"};

constexpr std::string_view name_of(EffectGroup group) {
  return kEffectGroupNames[static_cast<std::size_t>(group)];
}

/// Which sizes an effect can have. 0 is always possible and means that the effect is not there.
enum class SizeRange : std::uint8_t { kAnySign = 0, kNotNegative, kFraction };

/// Effects that look alike in a recording; at most three.
class Aliases {
 public:
  constexpr Aliases() = default;
  template <class... Others>
  constexpr explicit Aliases(Effect first, Others... others)
      : effect_{first, others...}, count_(1 + sizeof...(others)) {}

  [[nodiscard]] constexpr std::span<const Effect> list() const { return {effect_.data(), count_}; }
  [[nodiscard]] constexpr bool contains(Effect effect) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (effect_[i] == effect) return true;
    }
    return false;
  }

 private:
  std::array<Effect, 3> effect_{};
  std::size_t count_ = 0;
};

/// One row of the catalogue. In the equations: w, v, i speed, feed speed and current; w0, v0, i0, CL0, T0 the
/// reference point; a the size; M, F, U what is added to the torque, force and voltage balance.
struct EffectInfo {
  Effect effect;
  std::string_view name;
  EffectGroup group;
  std::string_view unit;
  SizeRange range;
  std::string_view equation;
  std::string_view excitation;   ///< without it there is nothing to see
  std::string_view separate_by;  ///< what would split it from its aliases or nearest relatives
  Aliases aliases{};
  std::string_view also_known{};  ///< causes outside the catalogue with the same equation
};

}  // namespace morepro::gap
