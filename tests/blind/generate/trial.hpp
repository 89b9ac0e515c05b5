#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ratio.hpp"

namespace blind {

/// What one trial is to hold. The seed decides everything else.
struct TrialSpec {
  std::string set = "rich";     ///< rich, production
  std::string kind = "single";  ///< none, parameters, single, pair, unknown, leave_one_out
  std::vector<std::string> effects;
  std::vector<double> ratios;  ///< wanted residual ratio of each effect alone
  std::uint64_t seed = 1;
  double duration_s = 10.0;
  bool is_varied = false;  ///< how it is recorded is drawn, too: Conditions
};

/// Makes the trial and writes recording, machine file and the options to diagnose it with into `directory`.
/// Returns the label. A trial whose effect cannot reach its ratio has no files and says `unreachable`.
nlohmann::json make_trial(const TrialSpec& spec, const std::string& id, const std::string& directory);

}  // namespace blind
