#pragma once
#include <span>

#include "lib/gap/effect_scales.hpp"
#include "sim_host/diagnose/board/board_watch.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// What an effect was found with, and what a machine file states it with.
struct ScalesOfEffects {
  gap::EffectScales<double> found;
  gap::EffectScales<double> stated;
};

FittedValues fitted_values(const MachineParameters& datasheet, std::span<const AxisOutcome> outcomes);

/// The machine with the values that fit best beside the effects that were found, and with these and the
/// faults of its samples, as it is after the recording: what set in stays. A coarse step becomes its
/// sensor's, and so do the steps of a sensor of which the file says nothing: it states what was assumed of
/// that from now on, beside which they would be a fault.
MachineDescription machine_with_effects(MachineDescription machine, const RecordingSignals& signals,
                                        std::span<const AxisOutcome> outcomes,
                                        std::span<const SamplingFault> faults, const ScalesOfEffects& scales);

}  // namespace morepro::host
