#pragma once
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/search/effect_search.hpp"

namespace morepro::host {

inline constexpr std::size_t kMostRivals = 3;

struct DuelTerms {
  double least_evidence = 0.0;  ///< that a candidate has to promise
  bool is_astray = false;       ///< the model as it is, as a beginning for others
};

/// Puts the best of `ranked` (not empty, most evidence first) into the model of `fit`, each for itself, with
/// everything refitted: the evidence of a linearisation does not tell a delay from a lag. Returns the fit of
/// the best, which is then in front, with what all of them are worth; `fit` where no trial came to anything.
AxisFit duel(const AxisFit& fit, const DuelTerms& terms, std::vector<Candidate>& ranked);

}  // namespace morepro::host
