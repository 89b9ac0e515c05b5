#pragma once
#include <algorithm>
#include <array>

#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_laws.hpp"
#include "lib/gap/effect_scales.hpp"
#include "lib/gap/friction_columns.hpp"
#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// A state after friction has acted on it for a step, what is left of a small difference before it, and, of
/// one friction alone, what a little more of what it takes away changes.
template <class Real>
struct FrictionStep {
  Real value = 0;
  Real slope = 1;
  Real by_loss = 0;
};

/// Exact solution of dx/dt = -a tanh(x / width) over a step of which `loss` = a h is the most that it takes
/// away: sinh(x / width) decays exponentially. Where friction is steep against a step its state sticks; an
/// explicit step swings instead. width > 0. A negative loss drives; that is an explicit step.
template <class Real>
FrictionStep<Real> friction_step(Real value, Real width, Real loss) {
  constexpr Real kFar = 20;  // beyond, sinh and cosh are the same
  if (loss < Real(0)) {
    const Real driven = math::tanh(value / width);
    return {value - loss * driven, Real(1), -driven};
  }
  const Real side = value < Real(0) ? Real(-1) : Real(1);
  const Real start = math::abs(value) / width;
  const Real end = start - loss / width;
  if (end > kFar) return {side * width * end, Real(1), -side};
  const Real grown = Real(0.5) * math::exp(end);
  const Real near = math::exp_of_nonpositive(Real(-2) * start);
  const Real sinh_end = grown * (Real(1) - near);
  const Real cosh_end = math::sqrt(Real(1) + sinh_end * sinh_end);
  return {side * width * math::log(sinh_end + cosh_end), grown * (Real(1) + near) / cosh_end,
          -side * sinh_end / cosh_end};
}

/// For how long a friction has to act before and after a step, so that one that does not change is right:
/// what it takes before is `kept` in part only, what both take is what it takes during all of the step.
template <class Real>
Real half_of(Real integral_s, Real kept) {
  return integral_s / (Real(1) + kept);
}

/// What a friction of one takes from its state before and after the rest of a step, so that one that does not
/// change is right in both of the axis's states: the other one sees only what was taken before. Over steps
/// that are longer than the states remember, where no such division takes from the state both times, and
/// where the other state sees nothing, it is right in its own one alone.
template <class Real>
struct Rubbing {
  Real before = 0;
  Real after = 0;
  Real all = 0;   ///< what it takes where it acts all the time
  Real kept = 1;  ///< of a unit of the state, after the step

  Rubbing() = default;
  /// Two halves, of a state that keeps everything.
  explicit Rubbing(Real half) : before(half), after(half), all(Real(2) * half) {}
  /// `own`, `other`: what a constant rate of the state makes of both in a step, and what is left there of a
  /// unit of the state; `inertia`: a load over the rate.
  Rubbing(Real own, Real own_kept, Real other, Real other_kept, Real inertia)
      : all(own / inertia), kept(own_kept) {
    Real before_s = other / other_kept;
    const bool is_division = before_s > Real(0) && before_s <= own && own_kept * before_s < own;
    if (!is_division) before_s = half_of(own, own_kept);
    before = before_s / inertia;
    after = (own - own_kept * before_s) / inertia;
  }

  /// What it takes where it acts during the last `share` of the step.
  [[nodiscard]] Real during_last(Real share) const {
    if (!forgets()) return share * all;
    return all * (Real(1) - math::exp(share * math::log(kept))) / (Real(1) - kept);
  }
  /// Share of the step in which the state goes a share of its way.
  [[nodiscard]] Real time_of(Real way) const {
    if (!forgets()) return way;
    return math::log(Real(1) - way * (Real(1) - kept)) / math::log(kept);
  }

 private:
  [[nodiscard]] bool forgets() const { return kept > Real(0) && kept < Real(0.999); }
};

/// Friction in two parts around the rest of a step (Strang), with the turn of a state that changes its side
/// in between: on the first side it acts until the turn, on the other from there on. `start`: the state
/// before the `first` part; `free`: before the `last` one, after the rest of the step. Gives the state after
/// all of it, and the slope of the last part; both slopes become 1 where the state drives through, because
/// then friction only delays it.
///
/// For the current, which crosses zero within one step; an axis that turns is `BrakedMotion`.
template <class Real>
FrictionStep<Real> around_a_turn(Real start, FrictionStep<Real>& first, Real free, FrictionStep<Real> last,
                                 const Rubbing<Real>& rubbing) {
  if (!(start * free < Real(0))) return last;
  const Real load_first = (first.value - start) / rubbing.before;
  const Real load_last = (last.value - free) / rubbing.after;
  const Real unrubbed = free - rubbing.kept * (first.value - start);
  const Real moved = unrubbed - start;
  const Real moved_until = moved + load_first * rubbing.all;
  // Friction would hold it: the parts know better how.
  if (!(moved * moved_until > Real(0) && moved * (moved + load_last * rubbing.all) > Real(0))) return last;
  const Real until = rubbing.time_of(std::clamp(-start / moved_until, Real(0), Real(1)));
  const Real since = rubbing.during_last(Real(1) - until);
  first.slope = Real(1);
  return {unrubbed + load_first * (rubbing.all - since) + load_last * since, Real(1)};
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

/// Which of the two states of its axis that is: speed and current, or position and speed.
constexpr std::size_t index_of(BrakedState state) { return state == BrakedState::kSpindleSpeed ? 0 : 1; }

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

/// What is left of a Stribeck friction at a value of its state: of each of its parts for a size of one and of
/// all of it, and how that changes with the state.
template <class Real>
struct Fall {
  Real near = 0;
  Real far = 0;
  Real left = 0;
  Real by_value = 0;

  Fall(Real value, Real per_range, bool has_bend, Real size, Real bend) {
    const Real ratio = value * per_range;
    const Real square = ratio * ratio;
    near = math::exp_of_nonpositive(-square);
    if (has_bend) far = math::exp_of_nonpositive(-square / Real(9)) - near;
    left = size * near + bend * far;
    // d exp(-(v/r)^2) / dv, and that of exp(-(v/3r)^2) - exp(-(v/r)^2).
    by_value = Real(-2) * ratio * per_range * (size * near + bend * ((near + far) / Real(9) - near));
  }
};

/// A dry friction at one value of its state: what it adds to the state's rate, how that changes with the
/// state, and what each part of its law would add with a size of one.
template <class Real>
struct FrictionAt {
  Real rate = 0;
  Real slope = 0;
  std::array<Real, kFrictionParts> by_part{};
};

/// A dry friction as it acts during one interval: what does not change meanwhile is worked out once.
template <class Real>
struct ActingFriction {
  Real size = 0;  ///< and the second part's, per what the state's rate is per load
  Real bend = 0;
  Real yield = 0;      ///< that
  Real per_width = 0;  ///< of the side
  Real per_range = 0;  ///< beyond which it is gone; 0: it stays
  bool has_bend = false;
  std::size_t index = 0;  ///< among those of the model

  [[nodiscard]] FrictionAt<Real> at(Real value) const {
    const Real side = math::tanh(value * per_width);
    const Real side_slope = per_width * (Real(1) - side * side);
    if (per_range == Real(0)) return {-size * side, -size * side_slope, {-yield * side}};
    const Fall<Real> fall(value, per_range, has_bend, size, bend);
    return {-fall.left * side,
            -fall.left * side_slope - fall.by_value * side,
            {-yield * side * fall.near, -yield * side * fall.far}};
  }
};

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

  [[nodiscard]] RubbedState<Real> step(Real value, const Braking<Real>& on,
                                       const EffectScales<Real>& k) const {
    const Real reach = static_cast<Real>(form.shape) * reference(k);
    if (is_stribeck(form.effect)) return stribeck(value, on, reach);
    const auto step = friction_step(value, blurred(reach, on.variance), size * on.yield);
    return {step.value, step.slope, {on.yield * step.by_loss}};
  }

  /// As it acts during an interval.
  [[nodiscard]] ActingFriction<Real> acting(const Braking<Real>& on, const EffectScales<Real>& k) const {
    const Real reach = static_cast<Real>(form.shape) * reference(k);
    return {.size = on.yield * size,
            .bend = on.yield * bend,
            .yield = on.yield,
            .per_width = Real(1) / blurred(side_width(reach), on.variance),
            .per_range = is_stribeck(form.effect) ? Real(1) / reach : Real(0),
            .has_bend = form.parts > 1};
  }

 private:
  [[nodiscard]] Real side_width(Real reach) const {
    return is_stribeck(form.effect) ? static_cast<Real>(laws::stribeck_side(form.effect)) * reach : reach;
  }
  [[nodiscard]] Real reference(const EffectScales<Real>& k) const {
    if (state() == BrakedState::kCurrent) return k.current_a;
    return state() == BrakedState::kFeedSpeed ? k.feed_speed_m_s : k.speed_rad_s;
  }

  /// A faster state is braked less: of a difference more may be left than there was.
  [[nodiscard]] RubbedState<Real> stribeck(Real value, const Braking<Real>& on, Real range) const {
    const Fall<Real> fall(value, Real(1) / range, form.parts > 1, size, bend);
    const auto step = friction_step(value, blurred(side_width(range), on.variance), fall.left * on.yield);
    const Real by_size = on.yield * step.by_loss;
    return {step.value, step.slope + by_size * fall.by_value, {by_size * fall.near, by_size * fall.far}};
  }
};

}  // namespace morepro::gap
