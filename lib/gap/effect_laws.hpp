#pragma once
#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_scales.hpp"
#include "lib/gap/effect_signals.hpp"
#include "lib/math/elementary.hpp"

/// Laws of the effects that need no memory, for a coefficient of one. Friction and contact loads oppose the
/// motion, so that a positive size is a load.
namespace morepro::gap::laws {

/// Direction of a motion, smooth within `width`.
template <class Real>
Real side(Real speed, Real width) {
  return math::tanh(speed / width);
}

/// What is left at a speed of friction that is gone beyond a range (Stribeck, with a Gaussian). Part 1, the
/// bend: what is left of it if it is gone beyond three times the range; both are like the exponentials of
/// other authors.
template <class Real>
Real breakaway(Real speed, Real range, int part) {
  const auto left = [speed](Real within) {
    const Real ratio = speed / within;
    return math::exp_of_nonpositive(-ratio * ratio);
  };
  return part == 0 ? left(range) : left(Real(3) * range) - left(range);
}

/// Of the range of Stribeck friction, where it changes its side: a share of the range, so that a curve is the
/// same whatever reference point its range is stated in.
constexpr float stribeck_side(Effect effect) {
  return effect == Effect::kSpindleStribeckFriction ? 0.02F : 1.0F / 30.0F;
}

/// Friction that is gone beyond a range of speeds.
template <class Real>
Real stribeck(Effect effect, Real speed, Real range, int part) {
  return -side(speed, static_cast<Real>(stribeck_side(effect)) * range) * breakaway(speed, range, part);
}

/// Sine (part 0, 2, ..) or cosine (1, 3, ..) of the angle, twice the angle (parts 2 and 3), .. Never copied
/// into its callers: it is large.
template <class Real>
[[gnu::noinline]] Real harmonic(Real angle_rad, int part) {
  const Real angle = angle_rad * static_cast<Real>(1 + part / 2);
  return part % 2 == 0 ? math::sin(angle) : math::cos(angle);
}

/// The same of so many times the spindle's angle.
template <class Real>
Real spindle_harmonic(const EffectSignals<Real>& s, Real multiple, int part) {
  if constexpr (kMayShare<Real>) {
    const auto* const known =
        s.multiples == nullptr ? nullptr : s.multiples->of(multiple * static_cast<Real>(1 + part / 2));
    if (known != nullptr) return part % 2 == 0 ? known->sin : known->cos;
  }
  return harmonic(multiple * s.angle_rad, part);
}

/// A load that passes with the teeth; kind 1: run-out, by which one tooth cuts more than another. Kinds 2 and
/// 3: the same of a torque that brakes either way the spindle turns.
template <class Real>
Real tooth_load(const EffectForm& form, int part, const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  if (s.contact == Real(0)) return Real(0);
  const Real contact = form.kind >= 2 && s.speed_rad_s < Real(0) ? -s.contact : s.contact;
  return contact * spindle_harmonic(s, form.kind % 2 == 0 ? k.teeth : Real(1), part);
}

// Of the reference speed: where a load of the cut changes its side.
inline constexpr float kSmoothShare = 0.002F;

/// Direction of a load of the cut, nothing in the air.
template <class Real>
Real cut_side(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  if (s.contact == Real(0)) return Real(0);
  return s.contact * side(s.speed_rad_s, static_cast<Real>(kSmoothShare) * k.speed_rad_s);
}

/// Torque in N m on the spindle, added to Kt i.
template <class Real>
Real torque(const EffectForm& form, int part, const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  const Real shape = static_cast<Real>(form.shape);
  const Real w = s.speed_rad_s;
  switch (form.effect) {
    case Effect::kSpindleCoulombFriction:  // shape: share of the reference speed
      return -side(w, shape * k.speed_rad_s);
    case Effect::kSpindleStribeckFriction:  // shape: share of the reference speed
      return stribeck(form.effect, w, shape * k.speed_rad_s, part);
    case Effect::kSpindleWindage:
      return -w * math::abs(w);
    case Effect::kSpindleCogging:  // shape: periods per revolution
      return -spindle_harmonic(s, shape, part);
    case Effect::kToothPassingTorque:
      return -tooth_load(form, part, s, k);
    case Effect::kContactSpeedDependence:
      return -cut_side(s, k) * (math::abs(w) / k.speed_rad_s - Real(1));
    case Effect::kContactChipLoadDependence:
      return -cut_side(s, k) * (s.chip_load_mm / k.chip_load_mm - Real(1));
    case Effect::kContactTemperatureDependence:
      return -cut_side(s, k) * (s.tool_degc - k.tool_degc) * Real(0.01);
    case Effect::kToolWearRamp:
      return -cut_side(s, k) * s.cutting_time_s;
    case Effect::kViscousTemperatureDependence:  // kind 1: the heat comes from the tool
      return -k.viscous_friction_nms_rad * w *
             (form.kind == 0 ? s.winding_degc - k.winding_degc : s.tool_degc - k.tool_degc);
    case Effect::kTorqueConstantSaturation:
      return -k.torque_constant_nm_a * s.current_a * s.current_a * s.current_a;
    case Effect::kArmatureReaction:  // kind 1: the weaker field weakens the torque too
      return form.kind == 0 ? Real(0) : -k.torque_constant_nm_a * s.current_a * math::abs(s.current_a);
    case Effect::kMagnetTemperatureDrift:  // kind 1: likewise
      return form.kind == 0 ? Real(0)
                            : -k.torque_constant_nm_a * s.current_a * (s.winding_degc - k.winding_degc);
    default:
      return Real(0);
  }
}

/// Voltage in V on the armature, added to V.
template <class Real>
Real voltage(const EffectForm& form, const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  switch (form.effect) {
    case Effect::kBrushVoltageDrop:  // shape: share of the reference current
      return -side(s.current_a, static_cast<Real>(form.shape) * k.current_a);
    case Effect::kResistanceTemperatureDrift:
      return -k.resistance_ohm * s.current_a * (s.winding_degc - k.winding_degc);
    case Effect::kInductanceSaturation:
      return k.inductance_h * s.current_a * s.current_a * s.current_rate_a_s;
    case Effect::kSupplyVoltageOffset:
      return Real(1);
    case Effect::kArmatureReaction:
      return k.back_emf_constant_vs_rad * s.speed_rad_s * math::abs(s.current_a);
    case Effect::kMagnetTemperatureDrift:
      return k.back_emf_constant_vs_rad * s.speed_rad_s * (s.winding_degc - k.winding_degc);
    default:
      return Real(0);
  }
}

template <class Real>
Real screw_rad_m(Real pitch_m, const EffectScales<Real>& k) {
  constexpr double kTurn = 6.283185307179586;
  return pitch_m > Real(0) ? static_cast<Real>(kTurn) / pitch_m : k.per_screw_turn_rad_m;
}

/// Force in N on the feed axis, added to F1.
template <class Real>
Real force(const EffectForm& form, int part, const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  const Real shape = static_cast<Real>(form.shape);
  const Real v = s.feed_speed_m_s;
  switch (form.effect) {
    case Effect::kFeedCoulombFriction:  // shape: share of the reference speed
      return -side(v, shape * k.feed_speed_m_s);
    case Effect::kFeedViscousFriction:
      return -v;
    case Effect::kFeedStribeckFriction:  // shape: share of the reference speed
      return stribeck(form.effect, v, shape * k.feed_speed_m_s, part);
    case Effect::kFeedAsymmetricFriction:
      return -math::abs(v) / k.feed_speed_m_s;
    case Effect::kFeedForceOffset:
      return Real(-1);
    case Effect::kFeedScrewPeriodic:  // shape: pitch in m, 0: the machine's
      return -harmonic(screw_rad_m(shape, k) * s.feed_position_m, part);
    case Effect::kFeedCuttingSpeedDependence:  // kind 1: on the feed's speed
      return -s.contact * (form.kind == 0 ? math::abs(s.speed_rad_s) / k.speed_rad_s - Real(1)
                                          : math::abs(v) / k.feed_speed_m_s - Real(1));
    case Effect::kFeedToothPassingForce:
      return -tooth_load(form, part, s, k);
    case Effect::kFeedSpring:  // part 1: it rests elsewhere
      return part == 0 ? -s.feed_position_m : Real(-1);
    case Effect::kFeedContactDrift:
      return -s.contact * s.cutting_time_s * Real(0.1);
    case Effect::kFeedForceSaturation:
      return -s.feed_force_n * s.feed_force_n * s.feed_force_n;
    default:
      return Real(0);
  }
}

/// How much the second part of a law that bends is of the first: 0 at the reference point or at none of its
/// cause. The bend of Stribeck friction is in its law: it is still there where the first part is gone.
template <class Real>
Real bend(const EffectForm& form, const EffectSignals<Real>& s, const EffectScales<Real>& k) {
  const auto square = [](Real ratio) { return ratio * ratio; };
  switch (form.effect) {
    case Effect::kSpindleStribeckFriction:
    case Effect::kFeedStribeckFriction:
      return Real(1);
    case Effect::kContactChipLoadDependence:
      return s.chip_load_mm / k.chip_load_mm - Real(1);
    case Effect::kContactTemperatureDependence:
      return (s.tool_degc - k.tool_degc) * Real(0.01);
    case Effect::kToolWearRamp:
    case Effect::kFeedContactDrift:
      return s.cutting_time_s * Real(0.1);
    case Effect::kTorqueConstantSaturation:
      return square(s.current_a / k.current_a);
    case Effect::kFeedForceSaturation:
      return square(s.feed_force_n / k.feed_force_n);
    case Effect::kFeedAsymmetricFriction:
      return math::abs(s.feed_speed_m_s) / k.feed_speed_m_s - Real(1);
    default:
      if (form.effect == Effect::kFeedCuttingSpeedDependence && form.kind == 1)
        return math::abs(s.feed_speed_m_s) / k.feed_speed_m_s - Real(1);
      return math::abs(s.speed_rad_s) / k.speed_rad_s - Real(1);
  }
}

/// What the spindle's speed sensor shows too much, in rad/s.
template <class Real>
Real speed_error(const EffectForm& form, int part, const EffectSignals<Real>& s) {
  if (form.effect == Effect::kSpindleSpeedBias) return Real(1);
  if (form.effect == Effect::kEncoderEccentricity) return s.speed_rad_s * harmonic(s.angle_rad, part);
  return Real(0);
}

/// What the current sensor shows too much, in A.
template <class Real>
Real current_error(const EffectForm& form, const EffectSignals<Real>& s) {
  if (form.effect == Effect::kCurrentBias) return Real(1);
  if (form.effect != Effect::kCurrentNonlinearity) return Real(0);
  return s.current_a * (form.kind == 0 ? math::abs(s.current_a) : s.current_a);
}

}  // namespace morepro::gap::laws
