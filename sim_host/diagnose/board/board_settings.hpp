#pragma once
#include <span>

#include "lib/gap/effect_scales.hpp"
#include "sim_host/diagnose/board/board_watch.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"

namespace morepro::host {

/// What a board needs to know of a machine to find what a diagnosis has found: its noise, what chance makes
/// of its recording, and the forms that its effects have; where something is left without a name, the
/// functions that take it. `excluded`: effects that it is not to look for either.
gap::GapSettings board_settings(std::span<const AxisOutcome> outcomes, const gap::GapNoise<double>& sensors,
                                bool is_unexplained, std::span<const gap::Effect> excluded, double rate_hz);

/// What of a machine's samples is no fault to a board: what its file states, and steps of the recording that
/// are none of the `faults`; steps and losses that are `excluded` are not looked for.
gap::SampleLimits samples_for_board(MachineDescription machine, const RecordingSignals& signals,
                                    std::span<const SamplingFault> faults,
                                    std::span<const gap::Effect> excluded);

/// From when on, and as what, a board is shown a recording of which this was found. `expected`: noise of a
/// machine like its datasheet.
BoardSight sight_of(std::span<const AxisOutcome> outcomes, const DiagnosisResult& result,
                    const gap::GapNoise<double>& expected);

/// The settings as a machine file states them that has `stated` others so far. `rate_ratio`: of the rate that
/// they were found at, over that of the recording; noise adds up over intervals.
GapTuning tuning_for_board(const gap::GapSettings& settings, const GapTuning& stated, double rate_ratio);

/// Those of the forms that have a name, stated for another reference point.
gap::MachineForms stated_forms(const gap::MachineForms& forms, const gap::EffectScales<double>& from,
                               const gap::EffectScales<double>& to);

}  // namespace morepro::host
