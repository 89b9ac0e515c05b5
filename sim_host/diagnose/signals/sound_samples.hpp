#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Leaves dead sensors out, and fills in what was not recorded but follows from the rest: the speed of a
/// spindle from its angle, a voltage that its current needs. Adds to `notices` what a user should know of it.
void complete(RecordingSignals& signals, Sensors& sensors, bool has_spindle,
              std::vector<std::string>& notices);

/// Takes out of `signals`, or allows for in `sensors`, what is wrong with the samples before any model looks
/// at them; gives what of it is an effect, and adds to `notices` what else a user should know. `assumed`,
/// bit_of(channel): the sensors of which the machine file says nothing.
std::vector<SamplingFault> make_sound(RecordingSignals& signals, Sensors& sensors, std::uint16_t assumed,
                                      std::vector<std::string>& notices);

}  // namespace morepro::host
