#pragma once
#include <span>
#include <string>
#include <vector>

#include "lib/gap/effect_form.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Every form of every effect that the recording could show on one axis, without the excluded effects.
std::vector<gap::EffectForm> candidate_forms(Axis axis, const RecordingSignals& signals,
                                             const GapModel& model, std::span<const gap::Effect> excluded);

/// Does the recording tell the second part of an effect's form, if it has one? What damps a bristle not as
/// means over several milliseconds, where a shaft is loaded not without a cut.
bool tells_second_part(gap::Effect effect, const RecordingSignals& signals);

/// Structure without a name, for what the catalogue does not explain.
std::vector<gap::EffectForm> unnamed_forms(Axis axis, const RecordingSignals& signals);

}  // namespace morepro::host
