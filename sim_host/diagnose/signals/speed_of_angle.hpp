#pragma once
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Fills in the speed in rad/s of a spindle of which the angle alone is recorded: how far it turns from the
/// row before to the row after, so that it is neither early nor late; `sensors` get the noise that it has
/// then, by the angle's, as stated or as it shows. An angle may begin anew with every turn, where it turns by
/// less than 0.4 of one from row to row. Was there anything to fill in?
bool take_speed_from_angle(RecordingSignals& signals, Sensors& sensors);

}  // namespace morepro::host
