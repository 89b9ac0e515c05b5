#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lib/gap/effect.hpp"
#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_info.hpp"
#include "lib/gap/gap_frame.hpp"

namespace morepro::gap {

/// Of two axes' verdicts the greater one is that of the machine.
enum class GapVerdict : std::uint8_t {
  kNotEnoughData = 0,
  kNoGap = 1,
  kInsufficientExcitation = 2,  ///< a cause may not be named from what the machine has done so far
  kParameterError = 3,          ///< other values of the nominal parameters explain it
  kUnexplained = 4,  ///< neither parameters nor an effect that the board knows: or the noise is another one
  kEffect = 5,
};

inline constexpr std::array<std::string_view, 6> kGapVerdictNames{
    "not_enough_data", "no_gap", "insufficient_excitation", "parameter_error", "unexplained", "effect"};

constexpr std::string_view name_of(GapVerdict verdict) {
  return kGapVerdictNames[static_cast<std::size_t>(verdict)];
}

inline constexpr std::size_t kMostAliases = 2;

/// What the watch has found.
struct GapFinding {
  GapVerdict verdict = GapVerdict::kNotEnoughData;
  EffectGroup where = EffectGroup::kSpindleTorque;  ///< meaningful for kEffect, as the following ones
  Effect effect = Effect::kSpindleCoulombFriction;
  std::uint8_t alias_count = 0;
  std::array<Effect, kMostAliases> alias{};  ///< explain it nearly as well
  float confidence = 0.0F;                   ///< 0 .. 1, that it is this effect or an alias of it
  float evidence = 0.0F;                     ///< n ln(RSS without / RSS with) - dof ln n; of any verdict
};

/// Forms that this machine, or another one like it, was seen to have, instead of the board's own forms of the
/// same effects; a form without parts only takes those away. Shapes in the unit of the law.
struct MachineForms {
  static constexpr std::size_t kMost = 4;
  static constexpr std::size_t kMostParts = 4;  ///< of all together
  std::array<EffectForm, kMost> form{};         ///< those behind `count` mean nothing
  std::uint32_t count = 0;                      ///< 0 .. kMost

  [[nodiscard]] bool has_room(const EffectForm& another) const {
    std::size_t parts = another.parts;
    for (std::size_t i = 0; i < count; ++i) parts += form[i].parts;
    return count < kMost && parts <= kMostParts;
  }
  [[nodiscard]] bool has(Effect effect) const {
    for (std::size_t i = 0; i < count; ++i)
      if (form[i].effect == effect) return true;
    return false;
  }
};

/// How far a datasheet may be off, as a standard deviation; relative.
inline constexpr double kDatasheetSpread = 0.5;

/// What a host has found by simulating the machine without an effect in the same excitation; stored.
struct GapLimits {
  double evidence = 25.0;    ///< > 0, that chance does not reach
  double temperature = 1.0;  ///< >= 1: how much more evidence chance makes than independent rows would
  double excitation = 5.0;   ///< > 0: how many times better than its datasheet each parameter must be known
  double noise_ratio = 1.0;  ///< > 0: residual power of the machine without a gap over that of expected noise
  /// > 0: how far the machine file's values may be off, as a standard deviation; relative. An effect that
  /// other values explain within that is none.
  double parameter_spread = kDatasheetSpread;
  MachineForms forms{};
};

/// What of the samples is no fault; 0: nobody looks, but for the jitter.
struct SampleLimits {
  float speed_step_rad_s = 0.0F;
  float current_step_a = 0.0F;
  float feed_step_m_s = 0.0F;
  float position_step_m = 0.0F;
  float lost_share = 0.0F;      ///< of the frames
  float clock_jitter_s = 0.0F;  ///< standard deviation that is known
};

/// Both axes, and the samples.
struct GapSettings {
  GapNoise<double> noise;
  GapLimits spindle;
  GapLimits feed;
  SampleLimits samples{};
};

}  // namespace morepro::gap
