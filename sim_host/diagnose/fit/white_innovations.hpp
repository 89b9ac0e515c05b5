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

/// The same of means over `rows` innovations each, from three of those before, `first` means back and on: of
/// noise of short memory the last one knows next to nothing, and those before it nothing; of what wanders all
/// of them do.
double slowly_predictable_deviance(const GapStatistics& statistics, std::size_t rows, std::size_t first = 1);

}  // namespace morepro::host
