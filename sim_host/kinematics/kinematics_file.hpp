#pragma once
#include <string>

#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host {

/// Reads a kinematics file (TOML; README.md lists the keys): points, placement, chain, method, each of them
/// optional. Throws UserError with line and column for malformed TOML, unknown keys and joint kinds, values
/// of the wrong type, tables that no chain can have.
KinematicsJob read_kinematics_file(const std::string& path);

/// "closed_form" or "clik"; throws UserError for another name.
InverseMethod inverse_method_of(const std::string& name);

}  // namespace morepro::host
