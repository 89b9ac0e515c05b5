#pragma once
#include <cstddef>

#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_laws.hpp"
#include "lib/gap/effect_memory.hpp"
#include "lib/gap/effect_scales.hpp"
#include "lib/gap/effect_signals.hpp"
#include "lib/gap/unnamed_laws.hpp"

namespace morepro::gap {

/// One part of one form of an effect, stepped once per interval with the same code in the simulated machine,
/// in the diagnosis on a PC and on the board. Sensor effects are evaluated at the interval's end, the others
/// in its middle. `kDelaySteps`: longest delay in steps that it can show.
template <class Real, std::size_t kDelaySteps>
class EffectTerm {
 public:
  EffectTerm() = default;
  /// 0 <= part < form.parts; step_s > 0.
  EffectTerm(const EffectForm& form, int part, double step_s)
      : form_(form), part_(part), step_s_(static_cast<Real>(step_s)) {
    start(form.shape, step_s);
  }

  [[nodiscard]] const EffectForm& form() const { return form_; }
  [[nodiscard]] int part() const { return part_; }

  /// What the effect adds during one step, for a coefficient of one; `k`: the machine's. Never copied into
  /// its callers: it is large.
  [[gnu::noinline]] Contribution<Real> step(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    switch (form_.effect) {
      case Effect::kShaftCompliance:
        return {.torque_nm =
                    k.inertia_kgm2 * resonance_(part_ == 0 ? s.acceleration_rad_s2 : cut_rad_s2(s, k))};
      case Effect::kDriveLag:
      case Effect::kFeedDriveLag:
        return lagging(s, k);
      case Effect::kFeedBacklash:
        return {.force_n = in_play(s, k)};
      case Effect::kFeedPresliding:
        return {.force_n = bristled(s.feed_speed_m_s)};
      case Effect::kSpindleSpeedDelay:
        return {.speed_rad_s = delayed(s.driven_speed_rad_s)};
      case Effect::kCurrentDelay:
        return {.current_a = delayed(s.driven_current_a)};
      case Effect::kFeedSpeedDelay:
        return {.feed_speed_m_s = delayed(s.driven_feed_speed_m_s)};
      case Effect::kSpindleSpeedBandwidth:
        return {.speed_rad_s = lag_.end(s.driven_speed_rad_s) - s.driven_speed_rad_s};
      case Effect::kCurrentBandwidth:
        return {.current_a = lag_.end(s.driven_current_a) - s.driven_current_a};
      case Effect::kUnnamedTorque:
      case Effect::kUnnamedVoltage:
      case Effect::kUnnamedForce:
        return unnamed(unnamed_law(s, k));
      case Effect::kSpindleCoulombFriction:
        if (is_bristle(form_)) return {.torque_nm = bristled(s.speed_rad_s)};
        [[fallthrough]];
      default:
        return by_law(s, k);
    }
  }

  /// The same of a function without a name that has this value; kind: its number. A shape is a time constant,
  /// through which it is seen.
  Contribution<Real> unnamed(Real value) {
    const Real seen = form_.shape > 0.0F ? lag_.end(value) : value;
    switch (form_.effect) {
      case Effect::kUnnamedTorque:
        return {.torque_nm = seen};
      case Effect::kUnnamedVoltage:
        return {.voltage_v = seen};
      default:
        return {.force_n = seen};
    }
  }

 private:
  /// Acceleration that the cut takes from the nominal model.
  static Real cut_rad_s2(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    const Real left_nm = k.torque_constant_nm_a * s.current_a - k.viscous_friction_nms_rad * s.speed_rad_s;
    return left_nm / k.inertia_kgm2 - s.acceleration_rad_s2;
  }

  void start(double shape, double step_s) {
    constexpr double kTurn = 6.283185307179586;
    if (form_.effect == Effect::kShaftCompliance)
      resonance_ = Resonance<Real>(kTurn * shape, kShaftDamping[form_.kind % kShaftDampings], step_s);
    if (is_lag()) lag_ = Lag<Real>(shape, step_s);
    delay_steps_ = static_cast<Real>(shape / step_s);
  }

  [[nodiscard]] bool is_lag() const {
    return form_.effect == Effect::kDriveLag || form_.effect == Effect::kFeedDriveLag ||
           form_.effect == Effect::kSpindleSpeedBandwidth || form_.effect == Effect::kCurrentBandwidth ||
           (form_.effect >= Effect::kUnnamedTorque && form_.shape > 0.0F);
  }

  Contribution<Real> lagging(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    if (form_.effect == Effect::kFeedDriveLag) return {.force_n = lag_.mean(s.feed_force_n) - s.feed_force_n};
    const Real mean_v = lag_.mean(s.armature_voltage_v) - s.armature_voltage_v;
    return {.voltage_v = mean_v * seen_by_current(k)};
  }

  /// A current forgets the beginning of a step before its end: of a voltage that lags, which is larger there,
  /// it sees less than the mean. To second order in the step over both time constants.
  Real seen_by_current(const EffectScales<Real>& k) const {
    const Real slow = Real(12) * static_cast<Real>(form_.shape) * k.inductance_h;
    return slow / (slow + step_s_ * step_s_ * k.resistance_ohm);
  }

  /// Effects of one group never act elsewhere, but for those of the flux, which act on voltage and torque.
  Contribution<Real> by_law(const EffectSignals<Real>& s, const EffectScales<Real>& k) const {
    const Real part = part_ == 1 && bends(form_.effect) ? laws::bend(form_, s, k) : Real(1);
    if (form_.effect < Effect::kFeedCoulombFriction)
      return {.torque_nm = part * laws::torque(form_, part_, s, k)};
    if (form_.effect < Effect::kBrushVoltageDrop) return {.force_n = part * laws::force(form_, part_, s, k)};
    if (form_.effect < Effect::kSpindleSpeedBias)
      return {.torque_nm = laws::torque(form_, part_, s, k), .voltage_v = laws::voltage(form_, s, k)};
    return {.speed_rad_s = laws::speed_error(form_, part_, s), .current_a = laws::current_error(form_, s)};
  }

  /// Part 1: what damps the bristle, per 1/s of its deflection (the model of Canudas de Wit).
  Real bristled(Real speed) {
    const auto deflection = bristle_(speed * step_s_, static_cast<Real>(form_.shape));
    return part_ == 0 ? -deflection.mean : -deflection.change / step_s_;
  }

  /// Drive and slide have half of the mass each. What the slide is braked with drives the two apart like the
  /// force on the drive; by half of that the drive is faster than both together. Part 1 is what the brake
  /// does of it: with other masses the two count differently.
  Real in_play(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    const Real per_half_mass = Real(2) / k.mass_kg;
    const Real brake_n = k.feed_viscous_friction_ns_m * s.feed_speed_m_s + s.contact * k.contact_load_n;
    const Real apart_n = s.feed_force_n + brake_n;
    const Real change_m_s = play_(apart_n * per_half_mass, (part_ == 0 ? apart_n : brake_n) * per_half_mass,
                                  static_cast<Real>(form_.shape), step_s_);
    return change_m_s / (per_half_mass * step_s_);
  }

  // Apart: with so many laws inside, every other term would take longer.
  [[gnu::noinline]] Real unnamed_law(const EffectSignals<Real>& s, const EffectScales<Real>& k) const {
    return form_.effect == Effect::kUnnamedForce ? laws::unnamed_feed(form_.kind, s, k)
                                                 : laws::unnamed_spindle(form_.kind, s, k);
  }

  Real delayed(Real value) {
    line_.push(value);
    return line_.before(delay_steps_) - value;
  }

  EffectForm form_;
  int part_ = 0;
  Real step_s_ = 0;
  Real delay_steps_ = 0;
  Lag<Real> lag_;
  Resonance<Real> resonance_;
  Bristle<Real> bristle_;
  Play<Real> play_;
  DelayLine<Real, kDelaySteps + 2> line_;
};

}  // namespace morepro::gap
