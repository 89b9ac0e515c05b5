#pragma once
#include "sim_host/diagnose/gap_model.hpp"
#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// Where voltage, speed and current of the spindle were recorded and no temperature of its winding: fills in
/// how the square of the current heats it, of the usual time constants by the one with which the drifts of
/// resistance and magnet explain most. Ten kelvins at the hottest: nobody knows how hot it was, so that a
/// drift has no size.
void heat_winding_by_current(RecordingSignals& signals, const GapModel& datasheet);

/// Does the effect follow a temperature of which only the course is known?
bool has_no_size(gap::Effect effect, const RecordingSignals& signals);

}  // namespace morepro::host
