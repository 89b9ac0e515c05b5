#pragma once
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/fit/gap_statistics.hpp"

namespace morepro::host {

/// The innovations of one sensor of a pass, whitened: of unit variance where the whitening was estimated.
std::vector<float> white_innovations(const GapStatistics& statistics, std::size_t sensor,
                                     const SensorWhitening& whitening);

/// By how much whitened innovations could still be predicted from those before, of both sensors, as a
/// deviance; 0 where chance does as much. Noise that lasts in a way that the observer does not know leaves
/// this, and in closed loop any function of the machine's motion may take some of it.
double predictable_deviance(const GapStatistics& statistics);

/// The same of means over `rows` innovations each, from three of those before: 1 is the last one, which still
/// knows a little of noise with a short memory; those before that one know of what wanders only.
double slowly_predictable_deviance(const GapStatistics& statistics, std::size_t rows, std::size_t first);

}  // namespace morepro::host
