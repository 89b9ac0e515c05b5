#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Is a jitter worth more than what named effects, or structure without a name, leave that looks like one?
bool is_worth_its_name(const SamplingFault& jitter, std::span<const AxisOutcome> outcomes);

/// A clock that shakes leaves structure of its own in every balance: of what has no name only another machine
/// from some time on, and what rings, are told beside one.
void forget_what_clock_leaves(const std::vector<SamplingFault>& faults, std::span<AxisOutcome> outcomes);

}  // namespace morepro::host
