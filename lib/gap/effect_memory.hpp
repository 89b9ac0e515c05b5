#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"
#include "lib/math/matrix_exponential.hpp"

namespace morepro::gap {

/// First-order lag with unit gain, stepped exactly.
template <class Real>
class Lag {
 public:
  Lag() = default;
  /// time_constant_s > 0, step_s > 0.
  Lag(double time_constant_s, double step_s) {
    const double decay = -step_s / time_constant_s;
    const auto step = math::exponential_step(math::Matrix2{.a00 = decay}, 1.0);
    keep_ = static_cast<Real>(step.exp.a00);
    mean_ = static_cast<Real>(step.integral.a00);
  }

  /// Output at the end of a step whose input went straight from that of the last step to this one.
  Real end(Real input) {
    const Real before = start(input);
    output_ = input + keep_ * (before - input) + (mean_ - keep_) * (input_ - input);
    input_ = input;
    return output_;
  }
  /// Mean output over a step whose input was held.
  Real mean(Real input) {
    const Real value = input + mean_ * (start(input) - input);
    output_ = input + keep_ * (output_ - input);
    return value;
  }

 private:
  Real start(Real input) {
    if (!is_started_) output_ = input_ = input;
    is_started_ = true;
    return output_;
  }

  Real keep_ = 0;
  Real mean_ = 0;
  Real output_ = 0;
  Real input_ = 0;
  bool is_started_ = false;
};

/// Second derivative of x in x'' + 2 z W x' + W^2 x = input, z = 0.05: what a two-mass shaft adds to the
/// acceleration of a rigid one.
template <class Real>
class Resonance {
 public:
  Resonance() = default;
  Resonance(double frequency_rad_s, double damping_ratio, double step_s) {
    const double stiffness = frequency_rad_s * frequency_rad_s;
    const double damping = 2.0 * damping_ratio * frequency_rad_s;
    const auto step = math::exponential_step(math::Matrix2{0.0, 1.0, -stiffness, -damping}, step_s);
    const auto cast = [](double v) { return static_cast<Real>(v); };
    exp_ = {cast(step.exp.a00), cast(step.exp.a01), cast(step.exp.a10), cast(step.exp.a11)};
    gain_x_ = cast(step.integral.a01);
    gain_rate_ = cast(step.integral.a11);
    stiffness_ = cast(stiffness);
    damping_ = cast(damping);
  }

  Real operator()(Real input) {
    const Real x = exp_.a00 * x_ + exp_.a01 * rate_ + gain_x_ * input;
    const Real rate = exp_.a10 * x_ + exp_.a11 * rate_ + gain_rate_ * input;
    const Real half = Real(0.5);
    const Real value = input - damping_ * half * (rate_ + rate) - stiffness_ * half * (x_ + x);
    x_ = x;
    rate_ = rate;
    return value;
  }

 private:
  math::BasicMatrix2<Real> exp_{};
  Real gain_x_ = 0;
  Real gain_rate_ = 0;
  Real stiffness_ = 0;
  Real damping_ = 0;
  Real x_ = 0;
  Real rate_ = 0;
};

/// A bristle that yields over a distance (Dahl's model): its deflection in units of the largest, -1 .. 1.
template <class Real>
class Bristle {
 public:
  struct Deflection {
    Real mean;    ///< over a step
    Real change;  ///< within it
  };
  Deflection operator()(Real travel_m, Real yield_m) {
    const Real side = travel_m < Real(0) ? Real(-1) : Real(1);
    const Real keep = math::exp_of_nonpositive(-side * travel_m / yield_m);
    const Real before = deflection_;
    deflection_ = side + (before - side) * keep;
    return {Real(0.5) * (before + deflection_), deflection_ - before};
  }

 private:
  Real deflection_ = 0;
};

/// Drive and slide with a play between them: each moves by itself inside it, and at its ends, where they meet
/// without bouncing, they are one. Starts in the middle.
template <class Real>
class Play {
 public:
  /// `acceleration`: at which the drive runs away from the slide inside the play. Returns what `part` of it
  /// changes in a step, until they meet and what it has gained is lost.
  Real operator()(Real acceleration_m_s2, Real part_m_s2, Real width_m, Real step_s) {
    const Real half = Real(0.5);
    const Real free = speed_m_s_ + acceleration_m_s2 * step_s;
    const Real wanted = place_m_ + half * (speed_m_s_ + free) * step_s;
    place_m_ = std::clamp(wanted, -half * width_m, half * width_m);
    const bool meets = place_m_ != wanted;
    const Real before = gained_m_s_;
    speed_m_s_ = meets ? Real(0) : free;
    gained_m_s_ = meets ? Real(0) : before + part_m_s2 * step_s;
    return gained_m_s_ - before;
  }

 private:
  Real place_m_ = 0;
  Real speed_m_s_ = 0;
  Real gained_m_s_ = 0;
};

/// The latest values of one signal, for delays up to kLength - 2 steps.
template <class Real, std::size_t kLength>
class DelayLine {
 public:
  void push(Real value) {
    newest_ = (newest_ + 1) % kLength;
    value_[newest_] = value;
    count_ = std::min(count_ + 1, kLength);
  }
  /// Value `steps` >= 0 before the newest one, linear in between; the oldest one where it is not there yet.
  Real before(Real steps) const {
    if (count_ == 0) return 0;
    const Real most = static_cast<Real>(count_ - 1);
    const Real bounded = std::min(steps, most);
    const auto whole = static_cast<std::size_t>(bounded);
    const Real part = bounded - static_cast<Real>(whole);
    const Real near = at(whole);
    return part > Real(0) ? near + part * (at(whole + 1) - near) : near;
  }

 private:
  Real at(std::size_t back) const { return value_[(newest_ + kLength - back) % kLength]; }

  std::array<Real, kLength> value_{};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace morepro::gap
