#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// How large evidence gets where there is nothing.
struct ChanceEvidence {
  double quantile99 = 0.0;   ///< of the best candidate's evidence
  double temperature = 1.0;  ///< variance of the candidates' scores over that of white rows, at least 1
  int runs = 0;
};

/// Draws the rows' residuals anew `runs` times, block by block with random signs: they keep their size, their
/// memory within a block and what ties them to the regressors, and lose what they have with them in common.
/// `statistics` was collected with `forms` at the fitted model.
ChanceEvidence chance_evidence(const AxisFit& fit, const GapStatistics& statistics,
                               const std::vector<gap::EffectForm>& forms, int runs, std::uint64_t seed,
                               const std::function<void()>& on_run);

}  // namespace morepro::host
