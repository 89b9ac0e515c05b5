#include "sim_host/diagnose/outcome/shaking_clock.hpp"

#include <algorithm>

namespace morepro::host {
namespace {

/// Moments at which a sensor surprises may be those of a clock.
bool is_told_beside_a_clock(const AxisOutcome& outcome) {
  return has_changed(outcome) || (passed_for_noise(outcome) && outcome.leftover.bursts.empty());
}

}  // namespace

// Of eight clocks that shake (another simulator) the jitter was worth 0.23 and more of the structure that it
// left itself, in the other axis too. A jitter of 0.8 us of 500, at 97 %, was worth 0.05 of what a guide left
// that brakes differently from place to place.
bool is_worth_its_name(const SamplingFault& jitter, std::span<const AxisOutcome> outcomes) {
  constexpr double kOfNamed = 0.05, kOfUnnamed = 0.1;
  double unnamed = 0.0;
  for (const AxisOutcome& outcome : outcomes)
    if (!is_told_beside_a_clock(outcome)) unnamed = std::max(unnamed, outcome.unnamed_deviance());
  return jitter.evidence >= std::max(kOfNamed * named_deviance_of(outcomes), kOfUnnamed * unnamed);
}

void forget_what_clock_leaves(const std::vector<SamplingFault>& faults, std::span<AxisOutcome> outcomes) {
  if (std::ranges::count(faults, gap::Effect::kClockJitter, &SamplingFault::effect) == 0) return;
  for (AxisOutcome& outcome : outcomes)
    if (!is_told_beside_a_clock(outcome)) outcome.leftover = {};
}

}  // namespace morepro::host
