#pragma once
#include "trial.hpp"

namespace blind {

/// How a trial is recorded.
struct Conditions {
  double sample_s = 1e-4, duration_s = 10.0;
  double loudness = 1.0;  ///< of the sensors of speeds, position and current
  /// Who controls with what the plant's state is, as simulators do, answers to random forces before a sensor
  /// shows them.
  bool controllers_see_state = false;
  bool is_white = false;  ///< random forces without memory
};

/// Drawn by the trial's seed where it is varied.
Conditions conditions_of(const TrialSpec& spec);

}  // namespace blind
