#pragma once
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// The most that the current's sensor can be noisy by, as a standard deviation, rounding included: what a
/// linear law of the row before (voltage, current, speed) and of this row's speed does not predict of a row's
/// current. Noise that is new in every row is in no such law. Of nine in ten pieces of 256 rows it is less; 0
/// where a signal or rows are lacking.
double most_noise_of_current(const RecordingSignals& signals);

}  // namespace morepro::host
