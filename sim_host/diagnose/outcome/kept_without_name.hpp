#pragma once
#include "sim_host/diagnose/outcome/axis_outcome.hpp"

namespace morepro::host {

/// What is there although no balance shows it, because an observer follows it as random forces or a robust
/// fit leaves it out: it becomes what the outcome has without a name.
void keep_what_no_balance_shows(AxisOutcome& outcome);

}  // namespace morepro::host
