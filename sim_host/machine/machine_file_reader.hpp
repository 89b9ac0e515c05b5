#pragma once
#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Reads a machine file (TOML; README.md of sim_host lists the keys). A table that is absent is not
/// described; a table that is there must have its required keys. Throws UserError with line, column and key
/// for malformed TOML, an unknown table or key, a value of the wrong type, and a value that no machine can
/// have.
MachineDescription read_machine_file(const std::string& path);

}  // namespace morepro::host
