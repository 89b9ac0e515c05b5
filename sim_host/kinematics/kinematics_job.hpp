#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/kinematics/morepro_machine.hpp"
#include "lib/kinematics/segment.hpp"
#include "lib/kinematics/task.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {

/// A point of a path file, before the placement.
struct PathPoint {
  kinematics::Waypoint<double> waypoint;
  double duration_s = 0.0;  ///< from the point before; 0 for the first
  TextPlace place;
};

enum class InverseMethod { kClosedForm, kClik };

/// What the tool can do along a path; infinite where nobody said.
struct ToolLimits {
  double speed_m_s = std::numeric_limits<double>::infinity();
  double acceleration_m_s2 = std::numeric_limits<double>::infinity();
};
inline ToolLimits stricter_of(const ToolLimits& a, const ToolLimits& b) {
  return {std::min(a.speed_m_s, b.speed_m_s), std::min(a.acceleration_m_s2, b.acceleration_m_s2)};
}

/// The chain: the built-in machine, or a table of the user's own.
struct ChainDescription {
  kinematics::MachineGeometry geometry;
  kinematics::DhTable table = kinematics::morepro_table();
  bool is_built_in = true;
  ToolLimits limits = {};
};

/// How joints are found along a path.
struct InverseDescription {
  std::optional<InverseMethod> method;  ///< by default closed form for the built-in machine, else CLIK
  double gain_per_s = 50.0;
  double rate_hz = 1000.0;
  double ramp_share = kinematics::kThirdOfTime;
  double tolerance = 1.0e-3;                             ///< m, rad: what a tool may be off in a point
  std::optional<kinematics::JointVector<double>> start;  ///< searched for by default
};

/// Everything that a kinematics file can say.
struct KinematicsJob {
  std::string file;
  ChainDescription chain;
  InverseDescription inverse;
  kinematics::Transform<double> placement;
  std::vector<PathPoint> points;
  kinematics::TaskRows rows = kinematics::kPositionRows;  ///< what the points prescribe
};

/// The method that is used: the one that was asked for, or the chain's default.
inline InverseMethod method_of(const KinematicsJob& job) {
  return job.inverse.method.value_or(job.chain.is_built_in ? InverseMethod::kClosedForm
                                                           : InverseMethod::kClik);
}

/// Names of the joints as the thesis has them: d1, d2, .. slide, t4, .. turn.
std::vector<std::string> joint_names(const kinematics::DhTable& table);

/// "m" or "rad", of a joint's variable.
constexpr std::string_view unit_of(const kinematics::DhJoint& joint) {
  return joint.kind == kinematics::JointKind::kRevolute ? "rad" : "m";
}

}  // namespace morepro::host
