#pragma once
#include <algorithm>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Moves a positive parameter by a step of its logarithm and keeps it in [1/50, 50] of its datasheet value,
/// so that a bad start cannot make it zero, negative or infinite.
template <class Real>
Real moved(Real value, Real log_step, Real datasheet) {
  const Real next = value * math::exp(std::clamp(log_step, Real(-2), Real(2)));
  return std::clamp(next, datasheet * Real(0.02), datasheet * Real(50));
}

}  // namespace morepro
