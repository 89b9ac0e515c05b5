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

/// Loads that pass with the teeth.
constexpr bool passes_with_teeth(gap::Effect effect) {
  return effect == gap::Effect::kToothPassingTorque || effect == gap::Effect::kFeedToothPassingForce;
}

/// Slow laws of the cut: they act in the same moments, and depend on what changes from cut to cut.
constexpr bool is_law_of_cut(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kContactSpeedDependence:
    case gap::Effect::kContactChipLoadDependence:
    case gap::Effect::kContactTemperatureDependence:
    case gap::Effect::kToolWearRamp:
    case gap::Effect::kFeedCuttingSpeedDependence:
    case gap::Effect::kFeedContactDrift:
      return true;
    default:
      return false;
  }
}

/// Fast ones: what their shapes leave where a machine's are others is fast, too, and no law of how it moves.
constexpr bool is_fast(gap::Effect effect) {
  return is_lag(family_of(effect)) || effect == gap::Effect::kShaftCompliance ||
         effect == gap::Effect::kInductanceSaturation;
}

/// Share of the evidence of an effect that another one of the same axis needs beside it; what the shape of
/// the first one leaves has less.
constexpr double least_share(gap::Effect effect, gap::Effect beside, double of_strangers) {
  constexpr double kOfFamily = 0.08;  // of strangers a known one needs less
  constexpr double kOfFast = 0.005;   // 14 that were not there had 0.0003 .. 0.0047
  constexpr double kOfCut = 0.2;      // five that were not there had 0.05 .. 0.17
  if (is_law_of_cut(effect) && (is_law_of_cut(beside) || passes_with_teeth(beside))) return kOfCut;
  if (!is_fast(effect) && is_fast(beside)) return kOfFast;
  const Family family = family_of(effect);
  return family != Family::kNone && family == family_of(beside) ? kOfFamily : of_strangers;
}

/// What comes back with every turn: at a constant speed, lines of a spectrum.
constexpr bool is_periodic(gap::Effect effect) {
  return family_of(effect) == Family::kPerTurn || passes_with_teeth(effect) ||
         effect == gap::Effect::kFeedScrewPeriodic;
}

/// Forces, torques and voltages that follow how the machine moves, slowly: in few states of a machine they
/// look alike.
constexpr bool is_slow_law(gap::Effect effect) {
  return !is_fast(effect) && !is_periodic(effect) && effect != gap::Effect::kFeedBacklash;
}

/// The plain effect that a finer one is a refinement of: what every machine has comes first, unless the
/// recording says otherwise clearly.
struct Plainer {
  gap::Effect fine;
  gap::Effect plain;
  double undecided;  ///< share of the finer one's evidence that the plain one needs
  bool stays;        ///< beside the finer one, once it was found, whatever it is worth then
};
// Friction that depends on the direction has two parts, one that grows with the speed and one that does not;
// they are stated together.
inline constexpr Plainer kPlainer[] = {
    {gap::Effect::kFeedStribeckFriction, gap::Effect::kFeedCoulombFriction, 0.75, false},
    {gap::Effect::kFeedPresliding, gap::Effect::kFeedCoulombFriction, 0.8, false},
    {gap::Effect::kSpindleStribeckFriction, gap::Effect::kSpindleCoulombFriction, 0.9, false},
    {gap::Effect::kSpindleCogging, gap::Effect::kSpindleCoulombFriction, 0.7, false},
    {gap::Effect::kFeedAsymmetricFriction, gap::Effect::kFeedForceOffset, 0.5, true},
    {gap::Effect::kFeedSpring, gap::Effect::kFeedForceOffset, 0.7, false},
};

/// On which side of a play a slide is, pieces of a recording do not tell, nor does any model know it for
/// long: its size can be right and the gap stay.
constexpr bool keeps_its_side(gap::Effect effect) { return effect == gap::Effect::kFeedBacklash; }

}  // namespace morepro::host
