#pragma once
#include <algorithm>
#include <limits>

#include "lib/gap/dry_friction.hpp"
#include "lib/math/matrix_exponential.hpp"
#include "lib/math/phi_functions.hpp"

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
  Real rubbing_s = 1;   ///< for how long its mean did that
};

/// The interval of an axis that turns, creeps, sticks or breaks away within it: dry friction changes with the
/// speed. Steps of an exponential method of third order (Hochbruck and Ostermann's exprb32), which takes what
/// friction is at a speed and how it changes there for exact and is as long as the rest stays small beside
/// the width of friction's side: an axis that creeps or sticks is one step, one that turns has some around
/// zero. Halves of friction around the whole interval took 8 N for 9 N and a mass for one 14 % larger, at 1
/// kHz, and at 10 kHz an axis that creeps was lost by 10 um in a second.
template <class Real>
class BrakedMotion {
 public:
  /// `braking_per_s` > 0: viscous friction over mass.
  BrakedMotion(Real braking_per_s, Real interval_s)
      : braking_per_s_(braking_per_s), interval_s_(interval_s) {}

  /// Over several milliseconds an input is a mean of what moved the axis, and does not tell when it turned;
  /// of a real axis, a ball screw seen at 200 Hz, a sharp turn at the wrong time left 3 N of presliding.
  /// Halves of friction around the interval do there.
  [[nodiscard]] bool tells_turns() const { return interval_s_ <= Real(4.0e-3); }

  /// `free_m_s2`: acceleration of an axis at rest without friction; `width_m_s`: of friction's side;
  /// `friction_at(speed_m_s)`: acceleration by it, and how that changes; `follow(growth, step_s)`: a step is
  /// done, in which differences of the speed grow so. False where there is no time for all the steps; then
  /// `motion` is as it was.
  template <class Friction, class Follow>
  [[nodiscard]] bool move(Real position_m, Real speed_m_s, Real free_m_s2, Real width_m_s,
                          Friction friction_at, Follow follow, Motion<Real>& motion) const {
    const Real tolerance_m_s = kTolerance * width_m_s;
    Difference<Real> by_speed{.speed = Real(1)}, by_rate;
    Difference<Real> moved{.speed = speed_m_s};
    Rate here = rate_of(friction_at(moved.speed), moved.speed, free_m_s2);
    follow.begin();
    Real left_s = interval_s_, step_s = interval_s_;
    for (int tries = 0; left_s > Real(0); ++tries) {
      if (tries == kMostTries) return false;
      step_s =
          std::min({step_s, before_zero(moved.speed, here.rate, width_m_s), before_overflow(here.slope)});
      const math::PhiFunctions<Real> own(step_s * here.slope);
      const Real ahead = step_s * own.phi1 * here.rate;
      const Real near_m_s = moved.speed + ahead;
      const Rate there = rate_of(friction_at(near_m_s), near_m_s, free_m_s2);
      const Real rest = there.rate - here.rate - here.slope * ahead;
      const Real correction = Real(2) * step_s * own.phi3 * rest;
      // Where the tangent meets friction again on the other side there is no rest, by chance; slopes tell.
      const Real bent = step_s * own.phi3 * (there.slope - here.slope) * ahead;
      const Real error = std::max(math::abs(correction), math::abs(bent));
      if (error > tolerance_m_s) {
        step_s *= error > Real(8) * tolerance_m_s ? Real(0.25) : Real(0.5);
        continue;
      }
      moved.position += step_s * (moved.speed + step_s * (own.phi2 * here.rate + Real(2) * own.phi4 * rest));
      moved.speed = near_m_s + correction;
      const math::PhiFunctions<Real> mean(step_s * Real(0.5) * (here.slope + there.slope));
      by_speed.advance(mean, step_s, Real(0));
      by_rate.advance(mean, step_s, Real(1));
      follow.step(mean, step_s);
      here = {there.rate + there.slope * correction, there.slope};
      left_s = step_s < left_s ? left_s - step_s : Real(0);
      step_s = std::min(error < tolerance_m_s / Real(8) ? Real(4) * step_s : step_s, left_s);
    }
    const Real gained = moved.speed - speed_m_s;
    motion = {.position_m = position_m + moved.position,
              .speed_m_s = moved.speed,
              .by_state = {Real(1), by_speed.position, Real(0), by_speed.speed},
              .by_rate = {interval_s_, by_rate.position, Real(0), by_rate.speed},
              .gained_m_s = gained,
              .rubbed_m_s = gained - free_m_s2 * interval_s_ + braking_per_s_ * moved.position,
              .rubbing_s = interval_s_};
    return true;
  }

 private:
  static constexpr Real kTolerance = Real(0.001);  // of the width
  static constexpr int kMostTries = 512;  // 142 were the most of two thousand, of curves crossed fast

  /// How long a step may be that leads towards zero from where friction does not change yet: it does from
  /// some widths on.
  static Real before_zero(Real speed_m_s, Real rate_m_s2, Real width_m_s) {
    constexpr Real kFar = Real(8), kNear = Real(5);
    const Real size = math::abs(speed_m_s);
    if (!(speed_m_s * rate_m_s2 < Real(0)) || size < kFar * width_m_s)
      return std::numeric_limits<Real>::max();
    return (size - kNear * width_m_s) / math::abs(rate_m_s2);
  }

  /// The same where a friction that drives lets differences grow.
  static Real before_overflow(Real slope_per_s) {
    constexpr Real kMostGrowth = Real(40);
    return slope_per_s > Real(0) ? kMostGrowth / slope_per_s : std::numeric_limits<Real>::max();
  }

  struct Rate {
    Real rate = 0;
    Real slope = 0;
  };
  Rate rate_of(const FrictionAt<Real>& friction, Real speed_m_s, Real free_m_s2) const {
    return {free_m_s2 - braking_per_s_ * speed_m_s + friction.rate, friction.slope - braking_per_s_};
  }

  Real braking_per_s_;
  Real interval_s_;
};

/// Instead of it, where no friction is part of the model.
struct NoBrakedMotion {
  template <class Real>
  NoBrakedMotion(Real, Real) {}
};

}  // namespace morepro::gap
