#pragma once
#include <array>

#include "lib/kinematics/dh_table.hpp"

namespace morepro::kinematics {

/// One number per joint, from the base; m or rad, or their rates. Those beyond the chain's count are 0.
template <class Real>
using JointVector = std::array<Real, kMaxJoints>;

}  // namespace morepro::kinematics
