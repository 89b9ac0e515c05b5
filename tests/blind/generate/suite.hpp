#pragma once
#include <string>
#include <vector>

#include "trial.hpp"

namespace blind {

/// The trials of a named suite (small, full, varied, dev_rich, dev_production), always the same for one seed.
/// Errors: std::runtime_error for an unknown name.
std::vector<TrialSpec> suite(const std::string& name, std::uint64_t seed);

/// `count` trials of one class; empty `effect` or ratio 0 draw them.
std::vector<TrialSpec> trials_of_class(const std::string& set, const std::string& kind,
                                       const std::string& effect, double ratio, int count,
                                       std::uint64_t seed);

}  // namespace blind
