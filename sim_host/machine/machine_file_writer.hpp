#pragma once
#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The machine as TOML that read_machine_file() reads back with the same values, bit by bit.
std::string machine_file_text(const MachineDescription& machine);

/// The same with every setting that the machine does not state: as a comment with the value that the program
/// chooses for whoever reads that file, because a changed sensor changes it. A built-in machine has some of
/// them tuned by hand, which the comments say.
std::string config_text(const MachineDescription& machine);

}  // namespace morepro::host
