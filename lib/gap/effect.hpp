#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace morepro::gap {

/// An equation of the machine that can fail to hold.
enum class Balance : std::uint8_t { kSpindleTorque = 0, kFeedForce, kArmatureVoltage };

inline constexpr std::size_t kBalanceCount = 3;
inline constexpr std::array<std::string_view, kBalanceCount> kBalanceNames{"spindle_torque", "feed_force",
                                                                           "armature_voltage"};

constexpr std::string_view name_of(Balance balance) {
  return kBalanceNames[static_cast<std::size_t>(balance)];
}

/// Physical effects that the nominal model leaves out. The order is that of kEffects.
enum class Effect : std::uint8_t {
  kSpindleCoulombFriction = 0,
  kSpindleStribeckFriction,
  kSpindleWindage,
  kSpindleCogging,
  kToothPassingTorque,
  kContactSpeedDependence,
  kContactChipLoadDependence,
  kContactTemperatureDependence,
  kToolWearRamp,
  kViscousTemperatureDependence,
  kTorqueConstantSaturation,
  kShaftCompliance,
  kFeedCoulombFriction,
  kFeedViscousFriction,
  kFeedStribeckFriction,
  kFeedAsymmetricFriction,
  kFeedForceOffset,
  kFeedScrewPeriodic,
  kFeedCuttingSpeedDependence,
  kFeedToothPassingForce,
  kFeedSpring,
  kFeedContactDrift,
  kFeedForceSaturation,
  kFeedDriveLag,
  kFeedBacklash,
  kFeedPresliding,
  kBrushVoltageDrop,
  kResistanceTemperatureDrift,
  kInductanceSaturation,
  kSupplyVoltageOffset,
  kDriveLag,
  kArmatureReaction,
  kMagnetTemperatureDrift,
  kSpindleSpeedBias,
  kCurrentBias,
  kSpindleSpeedDelay,
  kCurrentDelay,
  kFeedSpeedDelay,
  kSpindleSpeedBandwidth,
  kCurrentBandwidth,
  kEncoderEccentricity,
  kCurrentNonlinearity,
  kSensorQuantization,
  kClockJitter,
  kSampleDropout,
  kUnnamedTorque,  ///< this and the following: structure that the catalogue has no name for
                   ///< (unnamed_laws.hpp)
  kUnnamedVoltage,
  kUnnamedForce,
};

inline constexpr std::size_t kEffectCount = 45;  ///< with a name

constexpr std::size_t index_of(Effect effect) { return static_cast<std::size_t>(effect); }

}  // namespace morepro::gap
