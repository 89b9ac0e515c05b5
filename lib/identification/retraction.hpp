#pragma once
#include <algorithm>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Moves a positive parameter by a step of its logarithm and keeps it in [1/50, 50] of its datasheet value,
/// so that a bad start cannot make it zero, negative or infinite.
template <class Real>
Real moved(Real value, Real log_step, Real datasheet) {
  // Nearly every step is small: there exp to third order is right to 3e-11.
  const bool is_small = math::abs(log_step) < Real(0.005);
  const Real factor =
      is_small ? Real(1) + log_step * (Real(1) + log_step * (Real(0.5) + log_step * Real(1.0 / 6.0)))
               : math::exp(std::clamp(log_step, Real(-2), Real(2)));
  return std::clamp(value * factor, datasheet * Real(0.02), datasheet * Real(50));
}

/// Has a value moved too far since its filter began to learn? What was learnt farther away is no knowledge of
/// the parameters here: slopes there were others, and a first transient taken with values wrong by a factor
/// of two would leave certainty that is not there. Asked once the filter claims to know a little: before, a
/// value only follows noise. `from`: the value then, > 0; `variance` of the logarithm, `start_variance` then.
template <class Real>
bool has_left(Real from, Real value, Real variance, Real start_variance) {
  constexpr Real kTrusted = Real(1.3), kLittle = Real(0.5);
  if (variance > kLittle * start_variance) return false;
  return value > kTrusted * from || from > kTrusted * value;
}

}  // namespace morepro
