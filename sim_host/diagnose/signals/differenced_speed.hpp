#pragma once
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Does the speed of the feed follow from its position, in what is fast, for the most part?
bool is_speed_of_position(const RecordingSignals& signals);

/// Takes the speed of the feed out where it is the difference of the recorded position, of this sample or a
/// later one and one before, up to twenty rows away, as exactly as it was written: it says nothing more, and
/// repeats the position's noise. Was it there?
bool leave_out_derived_speed(RecordingSignals& signals);

/// Speeds that were shown as differences of a rounded position, as counters do. Two roundings are in each
/// sample, twice the variance of a rounded speed: `sensors` get the second one as noise.
std::vector<Channel> allow_for_differences(const RecordingSignals& signals, Sensors& sensors);

}  // namespace morepro::host
