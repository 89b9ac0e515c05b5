#pragma once
#include "lib/gap/gap_frame.hpp"
#include "lib/plant/machine_parameters.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Where the spindle's speed and current were recorded and its voltage was not, as drives report them: fills
/// in a voltage that takes the current of `current_source` from each sample to the next, straight. The
/// current then drives the torque balance; of the voltage balance nothing is known. Has it?
bool drive_by_current(RecordingSignals& signals);

/// A spindle that has no voltage balance, and what its observer expects: the current changes by its input
/// alone, and the sensor is right, but for its noise and its faults.
struct CurrentSource {
  MachineParameters machine;
  gap::GapNoise<double> noise;
};
CurrentSource current_source(const MachineParameters& machine, const gap::GapNoise<double>& noise);

}  // namespace morepro::host
