#pragma once
#include <span>
#include <vector>

namespace morepro::host {

/// Deviance that the strongest lines of a white sequence of unit variance take beyond what chance makes of
/// it; 0 where there is none. A line is one frequency with its phase.
double line_gain(std::span<const float> white);

}  // namespace morepro::host
