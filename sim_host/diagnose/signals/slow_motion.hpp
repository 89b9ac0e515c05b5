#pragma once
#include <optional>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// A feed axis that is known by its position alone, seen at about 200 Hz. Nothing where it is not recorded
/// faster, or where means of the force over these intervals would move the axis from where the force itself
/// does by more than the position's noise: that would be another axis.
std::optional<RecordingSignals> slow_motion_of(const RecordingSignals& signals,
                                               const MonitorConfiguration& machine);

}  // namespace morepro::host
