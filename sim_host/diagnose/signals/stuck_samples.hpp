#pragma once
#include <string>
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Takes the samples of sensors that hang out of `signals`, and notes the sensors there: one value for more
/// than twenty rows, of a sensor that has just shown its noise, while the other sensor of its axis shows that
/// it moves. A fit would follow them. An axis with one sensor has nothing that tells.
void leave_out_stuck_samples(RecordingSignals& signals, const Sensors& sensors);

/// What a user is told of one.
std::string sentence_of(const StuckSensor& stuck, const RecordingSignals& signals);

}  // namespace morepro::host
