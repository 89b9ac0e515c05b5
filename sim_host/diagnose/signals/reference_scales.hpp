#pragma once
#include "lib/gap/effect_signals.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The machine's reference point; what a machine without a described tool does not say is taken from the
/// recording.
gap::ReferencePoint reference_point_for(const MachineDescription& machine, const RecordingSignals& signals);

}  // namespace morepro::host
