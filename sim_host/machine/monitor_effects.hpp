#pragma once
#include <string>
#include <vector>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Puts the machine's effects into the monitor's configuration, whose sampling rate is final. Adds a sentence
/// to `notices` for those that the monitor has no room for, and for forms that it cannot look for at this
/// rate, which are dropped. A machine from a recording keeps what it was
/// recorded with.
void know_effects(MachineDescription& machine, std::vector<std::string>& notices);

}  // namespace morepro::host
