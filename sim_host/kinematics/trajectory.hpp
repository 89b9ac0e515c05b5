#pragma once
#include <cstddef>
#include <functional>

#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host {

/// One sample of a trajectory.
struct TrajectoryRow {
  double time_s = 0.0;
  kinematics::JointVector<double> joints{};                             ///< m, rad
  kinematics::JointVector<double> rate{};                               ///< m/s, rad/s
  kinematics::JointVector<double> acceleration{};                       ///< m/s2, rad/s2
  kinematics::ToolState<double> tool;                                   ///< wanted
  kinematics::Twist<double> error = kinematics::Twist<double>::Zero();  ///< wanted minus reached, m and rad
};

struct TrajectorySummary {
  std::size_t rows = 0;
  std::size_t segments = 0;
  double duration_s = 0.0;
  double largest_error = 0.0;  ///< of the wanted rows, m and rad together
  bool passed_singularity = false;
};

/// Joints along a path, one row every 1/rate from 0 to the first sample that is not before its end. Throws
/// UserError for a path that cannot be: fewer than two points, coincident points, impossible times, gain,
/// rate, method or orientation; and, with its time, where the tool cannot follow or a joint leaves its
/// limits.
TrajectorySummary compute_trajectory(const KinematicsJob& job,
                                     const std::function<void(const TrajectoryRow&)>& on_row);

/// Joint values for one pose, by the chain's method; `rows` say what of the pose is prescribed. Throws
/// UserError for a pose out of reach.
kinematics::JointVector<double> joints_for(const ChainDescription& chain, kinematics::TaskRows rows,
                                           const kinematics::Waypoint<double>& pose);

}  // namespace morepro::host
