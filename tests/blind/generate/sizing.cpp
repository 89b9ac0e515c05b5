#include "sizing.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {

constexpr int kMostRuns = 8;

SizedRun attempt(const Scenario& s, const Candidate& candidate, const Floor& floor, double strength) {
  const auto effect = made(candidate, s.machine, strength);
  SizedRun result{.run = simulate(s, {{effect.get(), candidate.onset_s}}), .strength = strength};
  result.has_holes =
      std::any_of(result.run.rows.begin(), result.run.rows.end(), [](const Row& r) { return r.is_missing; });
  result.is_reachable = result.run.is_finite;
  if (result.run.is_finite) result.ratios = residual_ratios(columns_of(result.run), s.machine, floor);
  return result;
}

/// Secant in logarithms of strength and excess: the excess of a small effect grows with its square.
class Search {
 public:
  Search(double strength, double wanted_excess) : strength_(strength), wanted_(std::log(wanted_excess)) {}

  double next(double ratio) {
    const double x = std::log(strength_), y = std::log(std::max(1e-4, ratio - 1.0));
    const double moved = x - last_x_;
    const double slope =
        has_last_ && std::abs(moved) > 1e-6 ? std::clamp((y - last_y_) / moved, 0.7, 4.0) : 2.0;
    last_x_ = x;
    last_y_ = y;
    has_last_ = true;
    strength_ = std::exp(x + std::clamp((wanted_ - y) / slope, -3.5, 1.5));
    return strength_;
  }

 private:
  double strength_, wanted_, last_x_ = 0.0, last_y_ = 0.0;
  bool has_last_ = false;
};

}  // namespace

double SizedRun::largest_ratio() const { return *std::max_element(ratios.begin(), ratios.end()); }

Balance SizedRun::balance() const {
  return static_cast<Balance>(std::max_element(ratios.begin(), ratios.end()) - ratios.begin());
}

std::unique_ptr<Effect> made(const Candidate& candidate, const Machine& machine, double strength) {
  Random shape(candidate.shape_seed, 21);
  auto effect = candidate.kind->make(shape, machine);
  effect->strength = strength;
  return effect;
}

SizedRun sized(const Scenario& s, const Candidate& candidate, const Floor& floor, double wanted_ratio) {
  const double guess = candidate.kind->guess(s.machine), limit = guess * candidate.kind->limit;
  Search search(guess, wanted_ratio - 1.0);
  double strength = guess;
  SizedRun result;
  for (int runs = 0; runs < kMostRuns; ++runs) {
    result = attempt(s, candidate, floor, strength);
    if (result.has_holes) return attempt(s, candidate, floor, std::min(0.1, 0.004 * wanted_ratio));
    const double ratio = result.run.is_finite ? result.largest_ratio() : 1e6;
    if (std::abs(ratio - wanted_ratio) <= 0.1 * (wanted_ratio - 1.0) + 0.005) return result;
    const double stronger = search.next(ratio);
    if (strength >= limit && stronger >= limit) break;
    strength = std::min(stronger, limit);
  }
  result.is_reachable = false;
  return result;
}

}  // namespace blind
