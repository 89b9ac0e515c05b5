#pragma once
#include "sim_host/diagnose/gap_model.hpp"
#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// Does an axis pass standstill, and so seldom that a quarter of the recording hardly shows what friction
/// does there? An axis whose speed was not recorded does not.
bool passes_standstill_seldom(Axis axis, const RecordingSignals& signals);

}  // namespace morepro::host
