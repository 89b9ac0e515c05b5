#pragma once
#include <cstdint>

#include "lib/gap/effect.hpp"

namespace morepro::gap {

/// One shape that an effect can have. Its parts enter a balance with a free coefficient each: sine and cosine
/// where a phase is not known, else there is one.
struct EffectForm {
  Effect effect = Effect::kSpindleCoulombFriction;
  std::uint8_t kind = 0;   ///< among the laws of one effect
  std::uint8_t parts = 1;  ///< 1 .. 4
  float shape = 0.0F;      ///< what the law is not linear in; its meaning stands with the law
};

/// Is the size that an engineer states the shape itself, with a coefficient of one?
constexpr bool size_is_shape(Effect effect) {
  switch (effect) {
    case Effect::kDriveLag:
    case Effect::kFeedDriveLag:
    case Effect::kFeedBacklash:
    case Effect::kSpindleSpeedDelay:
    case Effect::kCurrentDelay:
    case Effect::kFeedSpeedDelay:
    case Effect::kSpindleSpeedBandwidth:
    case Effect::kCurrentBandwidth:
      return true;
    default:
      return false;
  }
}

/// Is there no law without a shape that is greater than 0?
constexpr bool needs_shape(Effect effect) {
  switch (effect) {
    case Effect::kSpindleCoulombFriction:
    case Effect::kSpindleStribeckFriction:
    case Effect::kSpindleCogging:
    case Effect::kShaftCompliance:
    case Effect::kFeedCoulombFriction:
    case Effect::kFeedStribeckFriction:
    case Effect::kFeedPresliding:
    case Effect::kBrushVoltageDrop:
      return true;
    default:
      return size_is_shape(effect);
  }
}

/// Does the effect sit in a sensor? Else it acts on the machine.
constexpr bool is_in_sensor(Effect effect) {
  return effect >= Effect::kSpindleSpeedBias && effect <= Effect::kSampleDropout;
}

/// Is it a delay by whole and broken samples, which takes a memory as long as itself?
constexpr bool is_delay(Effect effect) {
  return effect == Effect::kSpindleSpeedDelay || effect == Effect::kCurrentDelay ||
         effect == Effect::kFeedSpeedDelay;
}

/// Is its law a plain one, whose form may have a second part that bends it? No machine has just these laws.
constexpr bool bends(Effect effect) {
  switch (effect) {
    case Effect::kSpindleStribeckFriction:
    case Effect::kFeedStribeckFriction:
    case Effect::kSpindleWindage:
    case Effect::kContactSpeedDependence:
    case Effect::kContactChipLoadDependence:
    case Effect::kContactTemperatureDependence:
    case Effect::kToolWearRamp:
    case Effect::kTorqueConstantSaturation:
    case Effect::kFeedAsymmetricFriction:
    case Effect::kFeedCuttingSpeedDependence:
    case Effect::kFeedContactDrift:
    case Effect::kFeedForceSaturation:
      return true;
    default:
      return false;
  }
}

/// May its form have a second part that refines it, whose size is not the effect's? A bend, what damps a
/// bristle, the force of a spring that rests elsewhere, a cut at the far end of the shaft.
constexpr bool may_be_refined(Effect effect) {
  switch (effect) {
    case Effect::kFeedPresliding:
    case Effect::kFeedSpring:
    case Effect::kShaftCompliance:
      return true;
    default:
      return bends(effect);
  }
}

/// Is it a friction that bends before it slides? Its shape is how far it yields: the feed's in m, and as
/// kind 1 of its dry friction the spindle's in rad.
constexpr bool is_bristle(const EffectForm& form) {
  return form.effect == Effect::kFeedPresliding ||
         (form.effect == Effect::kSpindleCoulombFriction && form.kind == 1);
}

/// Is it friction that is gone beyond a range of speeds?
constexpr bool is_stribeck(Effect effect) {
  return effect == Effect::kSpindleStribeckFriction || effect == Effect::kFeedStribeckFriction;
}

/// Damping ratios of a compliant shaft's swinging, by the form's kind.
inline constexpr double kShaftDamping[] = {0.05, 0.025, 0.0125, 0.1, 0.2, 0.035, 0.018, 0.07, 0.14};
inline constexpr int kShaftDampings = static_cast<int>(sizeof(kShaftDamping) / sizeof(double));

/// Can the effect act in one direction only? Friction brakes, a lag lags, a play is not negative; iron and
/// drives saturate, copper resists more as it warms, tools only wear.
constexpr bool acts_one_way(Effect effect) {
  switch (effect) {
    case Effect::kSpindleCoulombFriction:
    case Effect::kSpindleStribeckFriction:
    case Effect::kSpindleWindage:
    case Effect::kShaftCompliance:
    case Effect::kFeedCoulombFriction:
    case Effect::kFeedViscousFriction:
    case Effect::kFeedStribeckFriction:
    case Effect::kFeedPresliding:
    case Effect::kBrushVoltageDrop:
    case Effect::kTorqueConstantSaturation:
    case Effect::kArmatureReaction:
    case Effect::kInductanceSaturation:
    case Effect::kResistanceTemperatureDrift:
    case Effect::kToolWearRamp:
    case Effect::kFeedForceSaturation:
      return true;
    default:
      return size_is_shape(effect);
  }
}

}  // namespace morepro::gap
