#pragma once
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Does the machine file say how the current heats its winding?
bool states_heat(const MachineParameters::Spindle& spindle);

/// Where voltage, speed and current of the spindle were recorded and no temperature of its winding: fills in
/// how the square of the current heats it, as the machine file states it. Where it does not, of the usual
/// time constants by the one with which the drifts of resistance and magnet explain most, and by ten kelvins
/// at the hottest: nobody knows how hot it was, so that a drift has no size.
void heat_winding_by_current(RecordingSignals& signals, const GapModel& datasheet);

/// Does the effect follow the temperature of a winding that was not recorded?
bool follows_heat(gap::Effect effect, const RecordingSignals& signals);

/// Does the effect follow a temperature of which only the course is known?
bool has_no_size(gap::Effect effect, const RecordingSignals& signals);

}  // namespace morepro::host
