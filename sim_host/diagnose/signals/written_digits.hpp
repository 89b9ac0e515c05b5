#pragma once
#include <string>
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// A column that was written with few digits, so that its steps are as coarse as its values are large.
struct WrittenDigits {
  Channel channel = Channel::kSpindleSpeed;
  int digits = 0;
  double step = 0.0;  ///< of its large values, unit of the channel
};

/// Significant digits that all values of a column have, as far as a float shows them; 0: more than five, or
/// values that are too few or too much alike to tell.
int digits_of(const std::vector<float>& column);
/// The step that these leave in a column's large values; 0 where there are more.
double written_step_of(const std::vector<float>& column);

/// Sensors whose digits leave coarser steps than `sensors` says; their last bit is set to these.
std::vector<WrittenDigits> allow_for_digits(RecordingSignals& signals, Sensors& sensors);

std::string sentence_of(const WrittenDigits& written);

}  // namespace morepro::host
