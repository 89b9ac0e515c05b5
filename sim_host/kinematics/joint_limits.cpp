#include "sim_host/kinematics/joint_limits.hpp"

#include <fmt/format.h>

#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host {

std::string outside_limits(const kinematics::DhTable& table, const kinematics::JointVector<double>& joints,
                           double slack) {
  for (std::size_t i = 0; i < table.count; ++i) {
    const kinematics::DhJoint& joint = table.joints[i];
    if (joints[i] >= joint.lowest - slack && joints[i] <= joint.highest + slack) continue;
    return fmt::format("joint {} would be at {:.6g} {}, outside {:.6g} .. {:.6g}", joint_names(table)[i],
                       joints[i], unit_of(joint), joint.lowest, joint.highest);
  }
  return {};
}

}  // namespace morepro::host
