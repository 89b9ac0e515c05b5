#pragma once
#include <string>

#include "lib/kinematics/joint_vector.hpp"

namespace morepro::host {

inline constexpr double kJointRounding = 1.0e-9;  ///< m, rad

/// "joint d1 would be at 1.2 m, outside -1 .. 1" for the first joint outside its limits; empty where none is.
/// `slack`, >= 0, in m or rad: how far beyond may be an error of the joints themselves, such as the lag of
/// CLIK at a target on the limit.
std::string outside_limits(const kinematics::DhTable& table, const kinematics::JointVector<double>& joints,
                           double slack);

}  // namespace morepro::host
