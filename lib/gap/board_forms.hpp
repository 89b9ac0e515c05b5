#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_info.hpp"

/// What a board looks for: of every effect the form or two of the host's grid that resemble the others enough
/// for them to be seen.
namespace morepro::gap {

inline constexpr std::size_t kBoardDelaySteps = 12;

/// A form as the board stores it. Delays and lags are in sampling intervals, so that they are short
/// everywhere.
struct BoardForm {
  Effect effect;
  float shape = 0.0F;
  std::uint8_t parts = 1;
  std::uint8_t kind = 0;
  bool shape_is_intervals = false;

  [[nodiscard]] constexpr EffectForm at(double step_s) const {
    const float unit = shape_is_intervals ? static_cast<float>(step_s) : 1.0F;
    return {.effect = effect, .kind = kind, .parts = parts, .shape = shape * unit};
  }
};

inline constexpr std::array kSpindleForms{
    BoardForm{Effect::kSpindleCoulombFriction, 0.002F},
    BoardForm{Effect::kSpindleStribeckFriction, 0.06F},
    BoardForm{Effect::kSpindleWindage},
    BoardForm{Effect::kSpindleCogging, 8.0F, 2},
    BoardForm{Effect::kToothPassingTorque, 0.0F, 2},
    BoardForm{Effect::kContactSpeedDependence},
    BoardForm{Effect::kContactChipLoadDependence},
    BoardForm{Effect::kContactTemperatureDependence},
    BoardForm{Effect::kToolWearRamp},
    BoardForm{Effect::kTorqueConstantSaturation},
    BoardForm{Effect::kBrushVoltageDrop, 0.02F},
    BoardForm{Effect::kResistanceTemperatureDrift},
    BoardForm{Effect::kSupplyVoltageOffset},
    BoardForm{Effect::kDriveLag, 3.0F, 1, 0, true},
    BoardForm{Effect::kDriveLag, 12.0F, 1, 0, true},
    BoardForm{Effect::kArmatureReaction},
    BoardForm{Effect::kSpindleSpeedBias},
    BoardForm{Effect::kCurrentBias},
    BoardForm{Effect::kSpindleSpeedDelay, 4.0F, 1, 0, true},
    BoardForm{Effect::kCurrentDelay, 3.0F, 1, 0, true},
    BoardForm{Effect::kCurrentDelay, 12.0F, 1, 0, true},
};

inline constexpr std::array kFeedForms{
    BoardForm{Effect::kFeedCoulombFriction, 0.01F},
    BoardForm{Effect::kFeedViscousFriction},
    BoardForm{Effect::kFeedStribeckFriction, 0.15F},
    BoardForm{Effect::kFeedAsymmetricFriction},
    BoardForm{Effect::kFeedForceOffset},
    BoardForm{Effect::kFeedScrewPeriodic, 0.0F, 2},
    BoardForm{Effect::kFeedSpring},
    BoardForm{Effect::kFeedCuttingSpeedDependence},
    BoardForm{Effect::kFeedContactDrift},
    BoardForm{Effect::kFeedForceSaturation},
    BoardForm{Effect::kFeedDriveLag, 8.0F, 1, 0, true},
    BoardForm{Effect::kFeedSpeedDelay, 4.0F, 1, 0, true},
    BoardForm{Effect::kFeedSpeedDelay, 12.0F, 1, 0, true},
};

template <std::size_t kCount>
constexpr std::size_t terms_of(const std::array<BoardForm, kCount>& forms) {
  std::size_t sum = 0;
  for (const BoardForm& form : forms) sum += form.parts;
  return sum;
}

/// Where an effect acts, without the catalogue's texts.
constexpr EffectGroup group_of(Effect effect) {
  if (effect < Effect::kFeedCoulombFriction) return EffectGroup::kSpindleTorque;
  if (effect < Effect::kBrushVoltageDrop) return EffectGroup::kFeedForce;
  if (effect < Effect::kSpindleSpeedBias) return EffectGroup::kArmatureVoltage;
  return effect < Effect::kClockJitter ? EffectGroup::kSensor : EffectGroup::kSampling;
}

/// Does a board look for it in the rows of the feed axis? Else in those of the spindle.
constexpr bool is_of_feed(Effect effect) {
  return group_of(effect) == EffectGroup::kFeedForce || effect == Effect::kFeedSpeedDelay ||
         effect == Effect::kUnnamedForce;
}

}  // namespace morepro::gap
