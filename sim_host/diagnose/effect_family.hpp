#pragma once
#include "lib/gap/effect.hpp"

namespace morepro::host {

/// What has the same cause, shows the same way and differs in shape: what is left of one after its own shape
/// was fitted looks like the others.
enum class Family { kNone, kDryFriction, kPerTurn, kElectricLag, kFeedLag };
constexpr Family family_of(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kFeedCoulombFriction:
    case gap::Effect::kFeedStribeckFriction:
    case gap::Effect::kFeedPresliding:
    case gap::Effect::kSpindleCoulombFriction:
    case gap::Effect::kSpindleStribeckFriction:
      return Family::kDryFriction;
    case gap::Effect::kSpindleCogging:
    case gap::Effect::kToothPassingTorque:
    case gap::Effect::kEncoderEccentricity:
      return Family::kPerTurn;
    case gap::Effect::kDriveLag:
    case gap::Effect::kCurrentDelay:
    case gap::Effect::kCurrentBandwidth:
    case gap::Effect::kSpindleSpeedDelay:
    case gap::Effect::kSpindleSpeedBandwidth:
      return Family::kElectricLag;
    case gap::Effect::kFeedDriveLag:
    case gap::Effect::kFeedSpeedDelay:
      return Family::kFeedLag;
    default:
      return Family::kNone;
  }
}

constexpr bool is_lag(Family family) { return family == Family::kElectricLag || family == Family::kFeedLag; }

/// On which side of a play a slide is, pieces of a recording do not tell, nor does any model know it for
/// long: its size can be right and the gap stay.
constexpr bool keeps_its_side(gap::Effect effect) { return effect == gap::Effect::kFeedBacklash; }

}  // namespace morepro::host
