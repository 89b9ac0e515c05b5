#pragma once
#include "sim_host/diagnose/outcome/diagnosis_options.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Where the model of the machine is wrong in a recording, which effect explains it, and how far the gap
/// shrinks with it. `with_effects` becomes the machine that was found: refitted parameters and effects. The
/// same seed gives the same result.
DiagnosisResult diagnose(const RecordingSignals& signals, const MachineDescription& machine,
                         const DiagnosisOptions& options, MachineDescription& with_effects);

}  // namespace morepro::host
