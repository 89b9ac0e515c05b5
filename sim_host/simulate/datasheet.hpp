#pragma once
#include <cstdint>

#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// What a datasheet of this machine might say: every parameter of the spindle and the feed axis that can be
/// identified or damps a motion is `fraction` too high or too low, by the seed. 0 <= fraction < 1.
MachineParameters datasheet_of(const MachineParameters& machine, double fraction, std::uint64_t seed);

}  // namespace morepro::host
