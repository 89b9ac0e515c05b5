#pragma once
#include <toml++/toml.h>

#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Reads [[effects]] of a machine file into a machine whose other tables have been read. `node` is what
/// stands at the key `effects`. Throws UserError with line and column.
void read_effects(const toml::node& node, const std::string& path, MachineDescription& machine);

/// Reads [[gap.forms]], the forms that a board looks for instead of its own, likewise.
void read_gap_forms(const toml::node& node, const std::string& path, MachineDescription& machine);

}  // namespace morepro::host
