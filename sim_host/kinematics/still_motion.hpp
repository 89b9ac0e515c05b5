#pragma once
#include <string>

#include "lib/kinematics/mobility.hpp"

namespace morepro::host {

/// "the tool is 0.1 m off along x, and no joint of this chain moves it along x; .." where an error holds more
/// than `tolerance` (m, rad) that no joint could remove at any pose; else empty.
std::string off_along_still(const kinematics::Mobility<double>& mobility,
                            const kinematics::Twist<double>& error, double tolerance);

/// "; the points prescribe 6 directions in which this chain can move, and it has 3 joints: .." where a task
/// asks for more at a time than there are joints, so that only special poses are in reach; else empty.
std::string too_few_joints(const kinematics::Mobility<double>& mobility, const kinematics::DhTable& table);

}  // namespace morepro::host
