#pragma once
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// The chip loads that a bank of 11 holds for a machine: at most 11 values with the nominal one among them,
/// in steps of a fifth of it or finer, all inside the range of the contact law.
HypothesisGrid grid_for(const MachineParameters& machine);

/// Process noise per step from the sensors' noise. Fractions of a sensor's standard deviation, between those
/// that were tuned for the built-in machines.
FilterTuning tuning_for(const Sensors& sensors, const HypothesisGrid& grid);

/// For the watch of the gap between model and machine, where no diagnosis has found anything out: a machine
/// that is hardly random.
GapTuning gap_tuning_for(const Sensors& sensors);

/// Chooses the tuning of the filters and of the watch of the gap, from the sensors, the hypotheses and the
/// rate.
void choose_tuning(MonitorConfiguration& configuration);

/// A configuration with what the program chooses where a machine file does not state it; the drift of the
/// chip load follows the hypotheses that the configuration has.
MonitorConfiguration chosen_for(MonitorConfiguration configuration, bool has_contact);

/// The same estimators at another sampling rate: the noise per second stays, the noise per step changes.
void set_rate(MonitorConfiguration& configuration, double rate_hz);

}  // namespace morepro::host
