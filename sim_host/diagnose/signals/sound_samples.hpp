#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Takes out of `signals`, or allows for in `sensors`, what is wrong with the samples before any model looks
/// at them; gives what of it is an effect, and adds to `notices` what else a user should know. `assumed`,
/// bit_of(channel): the sensors of which the machine file says nothing.
std::vector<SamplingFault> make_sound(RecordingSignals& signals, Sensors& sensors, std::uint16_t assumed,
                                      std::vector<std::string>& notices);

}  // namespace morepro::host
