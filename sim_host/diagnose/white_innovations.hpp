#pragma once
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/gap_statistics.hpp"

namespace morepro::host {

/// The innovations of one sensor of a pass, whitened: of unit variance where the whitening was estimated.
std::vector<float> white_innovations(const GapStatistics& statistics, std::size_t sensor,
                                     const SensorWhitening& whitening);

}  // namespace morepro::host
