#pragma once
#include <string>

#include "lib/gap/applied_effect.hpp"

namespace morepro::host {

/// Limits that a run sets to the effects in it.
struct EffectLimits {
  double duration_s = 0.0;
  double rate_hz = 0.0;
};

/// NAME=SIZE[,from=SECONDS] as a user writes it. Throws UsageError for an unknown name, a size that the
/// effect cannot have and an onset outside the run.
gap::AppliedEffect effect_from_option(const std::string& text, const gap::EffectScales<double>& scales,
                                      const EffectLimits& limits);

/// Empty, or why an effect cannot be simulated at this sampling rate.
std::string objection_to_rate(const gap::AppliedEffect& effect, double rate_hz);

}  // namespace morepro::host
