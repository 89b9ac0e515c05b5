#pragma once
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/wire/field_list.hpp"

namespace morepro::wire {

template <>
inline constexpr auto kFields<gap::GapFinding> = std::tuple{
    &gap::GapFinding::verdict,     &gap::GapFinding::where, &gap::GapFinding::effect,
    &gap::GapFinding::alias_count, &gap::GapFinding::alias, &gap::GapFinding::confidence,
    &gap::GapFinding::evidence,
};

template <>
constexpr bool is_known(gap::GapVerdict verdict) {
  switch (verdict) {
    case gap::GapVerdict::kNotEnoughData:
    case gap::GapVerdict::kNoGap:
    case gap::GapVerdict::kInsufficientExcitation:
    case gap::GapVerdict::kParameterError:
    case gap::GapVerdict::kUnexplained:
    case gap::GapVerdict::kEffect:
      return true;
  }
  return false;
}

template <>
constexpr bool is_known(gap::EffectGroup group) {
  switch (group) {
    case gap::EffectGroup::kSpindleTorque:
    case gap::EffectGroup::kFeedForce:
    case gap::EffectGroup::kArmatureVoltage:
    case gap::EffectGroup::kSensor:
    case gap::EffectGroup::kSampling:
      return true;
  }
  return false;
}

/// Those with a name: no board finds or knows another one.
template <>
constexpr bool is_known(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kSpindleCoulombFriction:
    case gap::Effect::kSpindleStribeckFriction:
    case gap::Effect::kSpindleWindage:
    case gap::Effect::kSpindleCogging:
    case gap::Effect::kToothPassingTorque:
    case gap::Effect::kContactSpeedDependence:
    case gap::Effect::kContactChipLoadDependence:
    case gap::Effect::kContactTemperatureDependence:
    case gap::Effect::kToolWearRamp:
    case gap::Effect::kViscousTemperatureDependence:
    case gap::Effect::kTorqueConstantSaturation:
    case gap::Effect::kShaftCompliance:
    case gap::Effect::kFeedCoulombFriction:
    case gap::Effect::kFeedViscousFriction:
    case gap::Effect::kFeedStribeckFriction:
    case gap::Effect::kFeedAsymmetricFriction:
    case gap::Effect::kFeedForceOffset:
    case gap::Effect::kFeedScrewPeriodic:
    case gap::Effect::kFeedCuttingSpeedDependence:
    case gap::Effect::kFeedToothPassingForce:
    case gap::Effect::kFeedSpring:
    case gap::Effect::kFeedContactDrift:
    case gap::Effect::kFeedForceSaturation:
    case gap::Effect::kFeedDriveLag:
    case gap::Effect::kFeedBacklash:
    case gap::Effect::kFeedPresliding:
    case gap::Effect::kBrushVoltageDrop:
    case gap::Effect::kResistanceTemperatureDrift:
    case gap::Effect::kInductanceSaturation:
    case gap::Effect::kSupplyVoltageOffset:
    case gap::Effect::kDriveLag:
    case gap::Effect::kArmatureReaction:
    case gap::Effect::kMagnetTemperatureDrift:
    case gap::Effect::kSpindleSpeedBias:
    case gap::Effect::kCurrentBias:
    case gap::Effect::kSpindleSpeedDelay:
    case gap::Effect::kCurrentDelay:
    case gap::Effect::kFeedSpeedDelay:
    case gap::Effect::kSpindleSpeedBandwidth:
    case gap::Effect::kCurrentBandwidth:
    case gap::Effect::kEncoderEccentricity:
    case gap::Effect::kCurrentNonlinearity:
    case gap::Effect::kSensorQuantization:
    case gap::Effect::kClockJitter:
    case gap::Effect::kSampleDropout:
      return true;
    case gap::Effect::kUnnamedTorque:
    case gap::Effect::kUnnamedVoltage:
    case gap::Effect::kUnnamedForce:
      return false;
  }
  return false;
}

}  // namespace morepro::wire
