#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Takes out of `signals`, or allows for in `sensors`, what is wrong with the samples before any model looks
/// at them; gives what of it is an effect, and adds to `notices` what else a user should know.
std::vector<SamplingFault> make_sound(RecordingSignals& signals, Sensors& sensors,
                                      std::vector<std::string>& notices);

}  // namespace morepro::host
