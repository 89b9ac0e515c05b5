#pragma once
#include <string>

#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host {

/// What there is to say about one set of joint values.
struct PoseReport {
  kinematics::JointVector<double> joints{};
  kinematics::Transform<double> tool;
  kinematics::Vector3<double> angles_rad;  ///< roll, pitch, yaw from the orientation at joint values 0
  kinematics::Jacobian<double> jacobian;
};

PoseReport report_of(const ChainDescription& chain, const kinematics::JointVector<double>& joints);

/// For a person.
std::string pose_text(const ChainDescription& chain, const PoseReport& report);
/// {"schema": "morepro.kinematics/1", "joints", "position_m", "angles_rad", "transform", "jacobian"}
std::string pose_json(const ChainDescription& chain, const PoseReport& report);

}  // namespace morepro::host
