#pragma once
#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The machine as TOML that read_machine_file() reads back with the same values, bit by bit.
std::string machine_file_text(const MachineDescription& machine);

/// What the program chose from the machine: hypotheses, process noise, rule. Comments, because no machine
/// file sets them.
std::string estimator_comments(const MonitorConfiguration& configuration);

}  // namespace morepro::host
