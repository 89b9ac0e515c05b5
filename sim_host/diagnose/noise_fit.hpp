#pragma once
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/gap_model.hpp"
#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// Sensor variances of the machine file, and the least process noise that an observer is given.
gap::GapNoise<double> least_noise(const Sensors& sensors);

/// Chooses the process noise of one axis under which the innovations are most likely, on some stretches of
/// the recording; never below that of `stated`, the machine file's. Of a thinned recording the position's
/// noise too, which may be less than stated.
void fit_noise(Axis axis, const RecordingSignals& signals, const gap::GapNoise<double>& stated,
               GapModel& model);

}  // namespace morepro::host
