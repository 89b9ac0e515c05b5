#pragma once
#include <string>

#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host {

/// Reads the points of a path from CSV: columns x_m, y_m, z_m, duration_s and any of roll, pitch, yaw with
/// _rad or _deg. Throws UserError with line and column.
void read_path_csv(const std::string& path, KinematicsJob& job);

}  // namespace morepro::host
