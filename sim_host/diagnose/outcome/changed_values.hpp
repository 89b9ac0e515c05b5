#pragma once
#include <optional>
#include <string>

#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// A machine that is another one from a time on: a payload was taken, a connector was changed.
struct ChangedValues {
  double time_s = 0.0;
  double deviance = 0.0;      ///< that two sets of values take of what one leaves
  double torque_share = 1.0;  ///< of what has changed, spindle axis: the rest is voltage
  std::string words;          ///< which values have changed, and by how much
};

/// Present where two machines, one before and one after, explain more than all names do and leave hardly
/// anything; else what changes is no value of the model. `least_evidence`: of a function that is left.
std::optional<ChangedValues> changed_values_of(const AxisDiagnosis& diagnosis, double least_evidence);

}  // namespace morepro::host
