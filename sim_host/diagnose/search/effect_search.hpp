#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What one form of an effect would take from the residual of the current model.
struct Candidate {
  gap::EffectForm form;
  Eigen::Index column = 0;  ///< its first in the moments
  double evidence = 0.0;    ///< n ln(RSS without / RSS with) - dof ln n
  double promised = 0.0;    ///< the same before any of the rivals was fitted
  std::vector<double> coefficient;
  double onset_s = 0.0;    ///< sets in there
  bool is_lifted = false;  ///< to what the best promises, so that it gets its trial
};

/// Every effect once, by its best form, most evidence first. Last those that would have to act the wrong way,
/// with no evidence: over all of the recording, that is.
std::vector<Candidate> rank_candidates(const AxisFit& axis, const GapStatistics& statistics,
                                       const std::vector<gap::EffectForm>& forms);

/// Lets every candidate set in later where that takes more than chance makes it; most evidence first again,
/// without those that are impossible even so, and without viscous friction from the start where that is a
/// parameter of the feed.
void let_set_in(const AxisFit& axis, const GapStatistics& statistics, std::vector<Candidate>& ranked);

/// The same with the onset within its block, and the shape between the grid's, that take most of a part of
/// the recording. The effect is not in the model yet.
Candidate refined(const AxisFit& axis, const Candidate& candidate);

/// The candidate comes first, and is promised at least `most`, as the best so far: it gets its trial.
void prefer(Candidate preferred, double most, std::vector<Candidate>& ranked);

}  // namespace morepro::host
