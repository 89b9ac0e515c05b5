#pragma once
#include <string>

#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The monitor's limits of a single value: beyond them it is a mistake of units. 0 is possible.
bool has_possible_magnitude(double value, double largest);

/// What must hold between the values of a machine file. Throws UserError at the value that breaks a rule:
/// melting above reference temperature, whole teeth, a chip load inside the contact law, [tool] with
/// [contact].
void check_rules(const MachineDescription& machine, const std::string& path);

}  // namespace morepro::host
