#pragma once
#include <span>

#include "lib/gap/applied_effect.hpp"

namespace morepro::host {

/// The fastest motion in 1/s that the effects bring into the machine, an upper bound: friction that changes
/// its side within a narrow width, a stiff shaft or spring. The simulated machine's steps follow it.
double fastest_rate(std::span<const gap::AppliedEffect> effects, const gap::EffectScales<double>& scales);

}  // namespace morepro::host
