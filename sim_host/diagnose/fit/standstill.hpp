#pragma once
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Does the feed axis pass standstill, and so seldom that a quarter of the recording hardly shows what
/// friction does there? One whose speed was not recorded does not.
bool passes_standstill_seldom(const RecordingSignals& signals);

}  // namespace morepro::host
