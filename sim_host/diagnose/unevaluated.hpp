#pragma once
#include <string>

#include "lib/gap/effect.hpp"
#include "sim_host/diagnose/gap_model.hpp"
#include "sim_host/diagnose/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// What a balance needs and the machine file or the recording does not have; empty: nothing is missing.
std::string why_not_evaluated(gap::Balance balance, const RecordingSignals& signals,
                              const MachineDescription& machine);

/// Can an axis be diagnosed at all? The spindle's voltage alone cannot.
bool is_evaluable(Axis axis, const RecordingSignals& signals, const MachineDescription& machine);

/// Which effects cannot be looked for although their balance is evaluated, and why; empty: none.
std::string untested_effects(const RecordingSignals& signals, const MachineDescription& machine);

}  // namespace morepro::host
