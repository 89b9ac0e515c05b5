#pragma once
#include <span>
#include <string>
#include <vector>

#include "lib/gap/effect_form.hpp"
#include "sim_host/diagnose/gap_model.hpp"
#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// Every form of every effect that the recording could show on one axis, without the excluded effects.
std::vector<gap::EffectForm> candidate_forms(Axis axis, const RecordingSignals& signals,
                                             const GapModel& model, std::span<const gap::Effect> excluded);

/// Does it tell what damps a bristle? Not as means over several milliseconds.
bool tells_damping(const RecordingSignals& signals);

/// Structure without a name, for what the catalogue does not explain.
std::vector<gap::EffectForm> unnamed_forms(Axis axis, const RecordingSignals& signals);

}  // namespace morepro::host
