#pragma once
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/machine/machine_toml.hpp"

namespace morepro::host {

/// Reads [bank], [tuning], [gap] and [wear] into a machine whose other tables are read, and chooses what they
/// do not state. Throws UserError with line, column and key for what is impossible.
void read_settings(MachineToml& file, MachineDescription& machine);

}  // namespace morepro::host
