#pragma once
#include <algorithm>
#include <cstddef>

#include "lib/gap/dry_friction.hpp"
#include "lib/math/matrix_exponential.hpp"

namespace morepro::gap {

/// Where a step leads to from a position and a speed, and its linearisation: by both of them, and by constant
/// additions to their derivatives.
template <class Real>
struct Motion {
  Real position_m = 0;
  Real speed_m_s = 0;
  math::BasicMatrix2<Real> by_state{Real(1), Real(0), Real(0), Real(1)};
  math::BasicMatrix2<Real> by_rate{};
  Real gained_m_s = 0;  ///< of speed
  Real rubbed_m_s = 0;  ///< of it by dry friction

  /// On by one step of what is linear; `rate`: the acceleration at its beginning.
  void drift(const math::BasicExponentialStep2<Real>& step, Real rate) {
    position_m += step.integral.a00 * speed_m_s + step.integral.a01 * rate;
    speed_m_s += step.integral.a11 * rate;
    by_state = step.exp * by_state;
    by_rate = step.exp * by_rate;
    by_rate.a00 += step.integral.a00;
    by_rate.a01 += step.integral.a01;
    by_rate.a10 += step.integral.a10;
    by_rate.a11 += step.integral.a11;
  }
  void rub(const FrictionStep<Real>& rubbed) {
    rubbed_m_s += rubbed.value - speed_m_s;
    speed_m_s = rubbed.value;
    by_state.a10 *= rubbed.slope;
    by_state.a11 *= rubbed.slope;
    by_rate.a10 *= rubbed.slope;
    by_rate.a11 *= rubbed.slope;
  }
};

/// For how long a friction has to act before and after a step, so that one that does not change is right:
/// what it takes before is `kept` in part only, what both take is what it takes during all of the step.
template <class Real>
Real half_of(Real integral_s, Real kept) {
  return integral_s / (Real(1) + kept);
}

/// The interval of an axis that turns, sticks or breaks away within it, in parts: dry friction has another
/// side, or none, in each of them. Halves of it around the whole interval took a friction of 8 N for 9 N and
/// a mass for one 14 % larger, at 1 kHz. What they are wrong by falls with the square of their number: where
/// friction hardly changes, a quarter of them will do.
template <class Real>
class MotionInParts {
 public:
  /// `braking_per_s` > 0: viscous friction over mass.
  MotionInParts(Real braking_per_s, Real step_s)
      : few_(std::max<std::size_t>(parts_of(step_s) / kFewer, 1), step_s, braking_per_s),
        many_(parts_of(step_s), step_s, braking_per_s),
        braking_per_s_(braking_per_s) {}

  /// Does friction that took `first` in the first half of the interval and `last` in the other need parts?
  [[nodiscard]] bool is_needed(Real first, Real last) const {
    return many_.count > 1 && !is_enough(1, first, last);
  }

  /// `first` and `last` as above; `free_m_s2`: acceleration of an axis at rest without friction;
  /// `rub(acting_s, speed_m_s)`: a speed after dry friction has acted on it for so long.
  template <class Rub>
  [[nodiscard]] Motion<Real> from(Real position_m, Real speed_m_s, Real first, Real last, Real free_m_s2,
                                  Rub rub) const {
    const Parts& parts = is_enough(few_.count, first, last) ? few_ : many_;
    Motion<Real> motion{.position_m = position_m, .speed_m_s = speed_m_s};
    const Real half_s = half_of(parts.step.integral.a11, parts.step.exp.a11);
    motion.rub(rub(half_s, motion.speed_m_s));
    for (std::size_t i = 1; i < parts.count; ++i) {
      motion.drift(parts.step, free_m_s2 - braking_per_s_ * motion.speed_m_s);
      motion.rub(rub(Real(2) * half_s, motion.speed_m_s));
    }
    motion.drift(parts.step, free_m_s2 - braking_per_s_ * motion.speed_m_s);
    motion.rub(rub(half_s, motion.speed_m_s));
    motion.gained_m_s = motion.speed_m_s - speed_m_s;
    return motion;
  }

 private:
  static constexpr std::size_t kFewer = 4;

  [[nodiscard]] static bool is_enough(std::size_t parts, Real first, Real last) {
    constexpr Real kSame = Real(0.002);  // of the friction, by which halves of one part may differ
    const Real change = kSame * static_cast<Real>(parts * parts);
    return math::abs(first - last) <= change * math::abs(first);
  }

  struct Parts {
    Parts(std::size_t parts, Real step_s, Real braking_per_s)
        : count(parts),
          step(math::exponential_step(math::BasicMatrix2<Real>{Real(0), Real(1), Real(0), -braking_per_s},
                                      step_s / static_cast<Real>(parts))) {}
    std::size_t count;
    math::BasicExponentialStep2<Real> step;
  };

  /// Over several milliseconds an input is a mean of what moved the axis, and does not tell when it turned;
  /// of a real axis, a ball screw seen at 200 Hz, a sharp turn at the wrong time left 3 N of presliding.
  static std::size_t parts_of(Real step_s) {
    constexpr Real kPartS = Real(6.25e-5), kMost = Real(32), kTellsTurnsS = Real(4.0e-3);
    if (step_s > kTellsTurnsS) return 1;
    return static_cast<std::size_t>(std::clamp(step_s / kPartS, Real(1), kMost));
  }

  Parts few_;
  Parts many_;
  Real braking_per_s_;
};

/// Instead of it, where no friction is part of the model.
struct NoParts {
  template <class Real>
  NoParts(Real, Real) {}
};

}  // namespace morepro::gap
