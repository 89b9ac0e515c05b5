#pragma once
#include <array>
#include <cstddef>

#include "lib/math/matrix_exponential.hpp"
#include "lib/math/phi_functions.hpp"

namespace morepro::gap {

/// Parts that the law of a dry friction has at most.
inline constexpr std::size_t kFrictionParts = 2;

/// A state after a dry friction has acted on it for a step: what is left of a small difference before it, and
/// what a little more of each part of its law adds.
template <class Real>
struct RubbedState {
  Real value = 0;
  Real slope = 1;
  std::array<Real, kFrictionParts> by_part{};
};

/// A small difference of a speed, and what it has become of a position, over steps in which it grows at one
/// rate.
template <class Real>
struct Difference {
  Real speed = 0;
  Real position = 0;

  /// `growth`: of a rate times the step; `push`: what is added to the speed's rate meanwhile.
  void advance(const math::PhiFunctions<Real>& growth, Real step_s, Real push) {
    position += step_s * (growth.phi1 * speed + step_s * growth.phi2 * push);
    speed = growth.exp * speed + step_s * growth.phi1 * push;
  }
};

/// What a little more of the model's own dry frictions changes in two states during an interval, followed
/// through all the steps that it is integrated in. A friction that holds its state changes nothing at all,
/// and one that falls with the speed the more the longer it lasts: the value of its law in the middle of the
/// interval tells neither.
template <class Real, std::size_t kMostFrictions>
class FrictionColumns {
 public:
  struct One {
    std::size_t friction = 0;
    std::size_t part = 0;
    std::size_t column = 0;
    std::array<Real, 2> change{};  ///< of the states
    // By a little more of that part: the rate of the second state where a step has begun, and where it ends.
    Real rate_here = 0;
    Real rate_there = 0;
  };

  /// Column `column` is of that part of that friction. False where there is no room.
  bool add(std::size_t friction, std::size_t part, std::size_t column) {
    if (count_ == one_.size()) return false;
    one_[count_++] = {friction, part, column};
    return true;
  }

  /// An interval begins.
  void begin() {
    for (std::size_t i = 0; i < count_; ++i) one_[i].change = {};
  }
  /// What a little more of each part of that friction adds to the rate of the second state.
  void push(std::size_t friction, const std::array<Real, kFrictionParts>& by_part) {
    for (std::size_t i = 0; i < count_; ++i)
      if (one_[i].friction == friction) one_[i].rate_there = by_part[one_[i].part];
  }
  /// Steps begin where it was pushed last.
  void begin_steps() {
    for (std::size_t i = 0; i < count_; ++i) one_[i].rate_here = one_[i].rate_there;
  }
  /// A step to where it was pushed last, in which differences of the second state grow so and the first state
  /// is its integral.
  void step(const math::PhiFunctions<Real>& growth, Real step_s) {
    for (std::size_t i = 0; i < count_; ++i) {
      One& one = one_[i];
      const Real push = Real(0.5) * (one.rate_here + one.rate_there);
      Difference<Real> difference{.speed = one.change[1], .position = one.change[0]};
      difference.advance(growth, step_s, push);
      one.change = {difference.position, difference.speed};
      one.rate_here = one.rate_there;
    }
  }
  /// A friction has acted on a state.
  void rub(std::size_t friction, std::size_t state, const RubbedState<Real>& rubbed) {
    for (std::size_t i = 0; i < count_; ++i) {
      Real& change = one_[i].change[state];
      change *= rubbed.slope;
      if (one_[i].friction == friction) change += rubbed.by_part[one_[i].part];
    }
  }
  /// Everything else has acted on both states.
  void drift(const math::BasicMatrix2<Real>& exp) {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto [a, b] = one_[i].change;
      one_[i].change = {exp.a00 * a + exp.a01 * b, exp.a10 * a + exp.a11 * b};
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const One& operator[](std::size_t i) const { return one_[i]; }

 private:
  std::array<One, kFrictionParts * kMostFrictions> one_{};
  std::size_t count_ = 0;
};

}  // namespace morepro::gap
