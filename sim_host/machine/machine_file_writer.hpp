#pragma once
#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The machine as TOML that read_machine_file() reads back with the same values, bit by bit.
std::string machine_file_text(const MachineDescription& machine);

/// What the program chooses for whoever reads that file: hypotheses, process noise. Comments, because a
/// changed sensor changes them. A built-in machine has some of them tuned by hand, which the comments say.
std::string estimator_comments(const MachineDescription& machine);

}  // namespace morepro::host
