#pragma once
#include <string>

#include "lib/kinematics/joint_vector.hpp"

namespace morepro::host {

/// "joint d1 would be at 1.2 m, outside -1 .. 1 m" for the first joint outside its limits; empty where none
/// is.
std::string outside_limits(const kinematics::DhTable& table, const kinematics::JointVector<double>& joints);

}  // namespace morepro::host
