#pragma once
#include <algorithm>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Moves a positive parameter by a step of its logarithm and keeps it in [1/50, 50] of its datasheet value,
/// so that a bad start cannot make it zero, negative or infinite.
template <class Real>
Real moved(Real value, Real log_step, Real datasheet) {
  // Nearly every step is small: to third order exp is exact to a rounding.
  const bool is_small = math::abs(log_step) < Real(0.01);
  const Real factor =
      is_small ? Real(1) + log_step * (Real(1) + log_step * (Real(0.5) + log_step * Real(1.0 / 6.0)))
               : math::exp(std::clamp(log_step, Real(-2), Real(2)));
  return std::clamp(value * factor, datasheet * Real(0.02), datasheet * Real(50));
}

}  // namespace morepro
