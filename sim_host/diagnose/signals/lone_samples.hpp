#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Samples of one sensor that stand alone, far from those before and after: a disturbed line, a bit that
/// tipped over. No machine moves like that.
struct LoneSamples {
  Channel channel = Channel::kSpindleSpeed;
  std::size_t count = 0;
  std::size_t first_row = 0;
  double farthest = 0.0;  ///< from the line through the neighbours, in standard deviations of the sensor
};

/// Takes them out of `signals`, where they are so few that no structure of the machine's makes them.
std::vector<LoneSamples> leave_out_lone_samples(RecordingSignals& signals, const Sensors& sensors);

/// What a user is told of them.
std::string sentence_of(const LoneSamples& lone, const RecordingSignals& signals);

}  // namespace morepro::host
