#pragma once
#include "ratio.hpp"

namespace blind {

/// One effect with its shape drawn, not yet sized.
struct Candidate {
  const EffectKind* kind = nullptr;
  std::uint64_t shape_seed = 1;
  double onset_s = 0.0;
};

struct SizedRun {
  Run run;
  double strength = 0.0;
  std::array<double, kBalances> ratios{};
  bool is_reachable = true;
  bool has_holes = false;  ///< rows are missing: there is no ratio

  double largest_ratio() const;
  Balance balance() const;
};

/// The effect as it is drawn by its seed, with the given strength.
std::unique_ptr<Effect> made(const Candidate& candidate, const Machine& machine, double strength);

/// Finds the strength at which the balance that shows the effect best has the wanted residual ratio.
SizedRun sized(const Scenario& scenario, const Candidate& candidate, const Floor& floor, double wanted_ratio);

}  // namespace blind
