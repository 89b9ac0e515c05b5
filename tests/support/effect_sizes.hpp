#pragma once
#include "lib/gap/effect_catalogue.hpp"

namespace morepro::gap {

/// A size that the reference machine shows within a fraction of a second, without falling apart.
constexpr double visible_size(Effect effect) {
  switch (effect) {
    case Effect::kSpindleWindage:
      return 2.0e-7;
    case Effect::kSpindleCoulombFriction:
    case Effect::kSpindleStribeckFriction:
    case Effect::kSpindleCogging:
    case Effect::kToothPassingTorque:
    case Effect::kContactSpeedDependence:
    case Effect::kContactChipLoadDependence:
    case Effect::kContactTemperatureDependence:
    case Effect::kToolWearRamp:
      return 0.05;
    case Effect::kTorqueConstantSaturation:
    case Effect::kInductanceSaturation:
      return 1.0e-4;
    case Effect::kShaftCompliance:
    case Effect::kFeedViscousFriction:
      return 20.0;
    case Effect::kFeedSpring:
      return 2000.0;
    case Effect::kFeedForceSaturation:
      return 1.0e-4;
    case Effect::kFeedContactDrift:
      return 50.0;
    case Effect::kFeedBacklash:
      return 2.0e-5;
    case Effect::kViscousTemperatureDependence:
      return 0.1;
    case Effect::kResistanceTemperatureDrift:
    case Effect::kMagnetTemperatureDrift:
    case Effect::kArmatureReaction:
    case Effect::kCurrentNonlinearity:
    case Effect::kEncoderEccentricity:
      return 0.01;
    case Effect::kDriveLag:
    case Effect::kFeedDriveLag:
    case Effect::kSpindleSpeedDelay:
    case Effect::kCurrentDelay:
    case Effect::kFeedSpeedDelay:
    case Effect::kSpindleSpeedBandwidth:
    case Effect::kCurrentBandwidth:
      return 1.0e-3;
    case Effect::kClockJitter:
      return 1.0e-5;
    case Effect::kSampleDropout:
      return 0.1;
    default:
      return 3.0;
  }
}

}  // namespace morepro::gap
