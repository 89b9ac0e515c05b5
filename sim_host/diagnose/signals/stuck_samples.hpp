#pragma once
#include <string>
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Takes the samples of sensors that hang out of `signals`, and notes the sensors there: one value for many
/// rows, where the sensor has noise, seldom shows the same twice, and its axis moves meanwhile. A fit would
/// follow them.
void leave_out_stuck_samples(RecordingSignals& signals, const Sensors& sensors);

/// What a user is told of one.
std::string sentence_of(const StuckSensor& stuck, const RecordingSignals& signals);

}  // namespace morepro::host
