#pragma once
#include <cstdint>
#include <functional>
#include <span>

#include "sim_host/diagnose/axis_diagnosis.hpp"
#include "sim_host/diagnose/diagnosis_result.hpp"
#include "sim_host/diagnose/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

struct DiagnosisOptions {
  int bootstrap_runs = 200;           ///< 0: a fixed threshold
  std::vector<gap::Effect> excluded;  ///< taken out of the catalogue
  std::uint64_t seed = 1;
  /// How far the search for effects is, 0 .. 1. Called by several threads, one at a time.
  std::function<void(double share)> on_progress = [](double) {};
  /// Called for each axis at the end, with all that was found out about it.
  std::function<void(const AxisDiagnosis&)> on_axis = [](const AxisDiagnosis&) {};
};

/// Where the model of the machine is wrong in a recording, which effect explains it, and how far the gap
/// shrinks with it. `with_effects` becomes the machine that was found: refitted parameters and effects. The
/// same seed gives the same result.
DiagnosisResult diagnose(const RecordingSignals& signals, const MachineDescription& machine,
                         const DiagnosisOptions& options, MachineDescription& with_effects);

}  // namespace morepro::host
