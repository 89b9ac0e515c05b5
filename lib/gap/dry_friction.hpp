#pragma once
#include <algorithm>

#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_laws.hpp"
#include "lib/gap/effect_scales.hpp"
#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// A state after friction has acted on it for a step, and what is left of a small difference before it.
template <class Real>
struct FrictionStep {
  Real value = 0;
  Real slope = 1;
};

/// Exact solution of dx/dt = -a tanh(x / width) over a step of which `loss` = a h is the most that it takes
/// away: sinh(x / width) decays exponentially. Where friction is steep against a step its state sticks; an
/// explicit step swings instead. width > 0. A negative loss drives; that is an explicit step.
template <class Real>
FrictionStep<Real> friction_step(Real value, Real width, Real loss) {
  constexpr Real kFar = 20;  // beyond, sinh and cosh are the same
  if (loss < Real(0)) return {value - loss * math::tanh(value / width), Real(1)};
  const Real side = value < Real(0) ? Real(-1) : Real(1);
  const Real start = math::abs(value) / width;
  const Real end = start - loss / width;
  if (end > kFar) return {side * width * end, Real(1)};
  const Real grown = Real(0.5) * math::exp(end);
  const Real near = math::exp_of_nonpositive(Real(-2) * start);
  const Real sinh_end = grown * (Real(1) - near);
  const Real cosh_end = math::sqrt(Real(1) + sinh_end * sinh_end);
  return {side * width * math::log(sinh_end + cosh_end), grown * (Real(1) + near) / cosh_end};
}

/// Friction in two halves around the rest of a step (Strang), with the turn of a state that changes its side
/// in between: on the first side it acts until the turn, on the other from there on, not half of the step
/// each. `start`: the state before the `first` half; `free`: before the `last` one, after the rest of the
/// step. Gives the state after all of it, and the slope of the last half; both slopes become 1 where the
/// state drives through, because then friction only delays it.
///
/// For the current, which crosses zero within one step; an axis that turns is `MotionInParts`.
template <class Real>
FrictionStep<Real> around_a_turn(Real start, FrictionStep<Real>& first, Real free, FrictionStep<Real> last) {
  if (!(start * free < Real(0))) return last;
  const Real lost_first = first.value - start, lost_last = last.value - free;
  const Real moved = free - first.value;
  const Real moved_until = moved + Real(2) * lost_first;
  // Friction would hold it: the halves know better how.
  if (!(moved * moved_until > Real(0) && moved * (moved + Real(2) * lost_last) > Real(0))) return last;
  const Real share = std::clamp(-start / moved_until, Real(0), Real(1));  // of the step until the turn
  first.slope = Real(1);
  return {last.value + (Real(2) * share - Real(1)) * (lost_first - lost_last), Real(1)};
}

/// Is it a friction that changes its side so steeply that its state may stick?
constexpr bool is_dry_friction(const EffectForm& form) {
  switch (form.effect) {
    case Effect::kSpindleCoulombFriction:
      return !is_bristle(form);
    case Effect::kSpindleStribeckFriction:
    case Effect::kFeedCoulombFriction:
    case Effect::kFeedStribeckFriction:
    case Effect::kBrushVoltageDrop:
      return true;
    default:
      return false;
  }
}

/// State that a dry friction brakes.
enum class BrakedState { kSpindleSpeed, kCurrent, kFeedSpeed };

/// What a dry friction acts on in a step of a model.
template <class Real>
struct Braking {
  BrakedState state = BrakedState::kSpindleSpeed;
  Real yield = 0;     ///< by how much a load of one changes the state meanwhile
  Real time_s = 0;    ///< of the recording, or since the start
  Real variance = 0;  ///< of the state, where it is an estimate
};

/// The width within which friction changes its side, averaged over all that the state may be: tanh is nearly
/// an error function, and the average of one over a normal distribution is a wider one.
template <class Real>
Real blurred(Real width, Real variance) {
  constexpr Real kHalfPi = Real(1.5707963267948966);
  return math::sqrt(width * width + kHalfPi * variance);
}

/// A dry friction of known size in a model; the laws are those of `laws::torque`, `laws::force` and
/// `laws::voltage`.
template <class Real>
struct DryFriction {
  EffectForm form;
  Real size = 0;  ///< N m, N or V
  Real bend = 0;  ///< likewise, of the second part
  Real onset_s = 0;

  [[nodiscard]] BrakedState state() const {
    if (form.effect < Effect::kFeedCoulombFriction) return BrakedState::kSpindleSpeed;
    return form.effect < Effect::kBrushVoltageDrop ? BrakedState::kFeedSpeed : BrakedState::kCurrent;
  }

  [[nodiscard]] FrictionStep<Real> step(Real value, const Braking<Real>& on,
                                        const EffectScales<Real>& k) const {
    const Real reach = static_cast<Real>(form.shape) * reference(k);
    if (is_stribeck(form.effect)) return stribeck(value, on, reach);
    return friction_step(value, blurred(reach, on.variance), size * on.yield);
  }

 private:
  [[nodiscard]] Real reference(const EffectScales<Real>& k) const {
    if (state() == BrakedState::kCurrent) return k.current_a;
    return state() == BrakedState::kFeedSpeed ? k.feed_speed_m_s : k.speed_rad_s;
  }

  [[nodiscard]] FrictionStep<Real> stribeck(Real value, const Braking<Real>& on, Real range) const {
    Real left = size * laws::breakaway(value, range, 0);
    if (bend != Real(0)) left += bend * laws::breakaway(value, range, 1);
    const Real width = static_cast<Real>(laws::stribeck_side(form.effect)) * range;
    return friction_step(value, blurred(width, on.variance), left * on.yield);
  }
};

}  // namespace morepro::gap
