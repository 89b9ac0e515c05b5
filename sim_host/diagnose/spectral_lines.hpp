#pragma once
#include <span>
#include <vector>

namespace morepro::host {

/// One frequency with its phase.
struct SpectralLine {
  double cycles_per_sample = 0.0;
  double power = 0.0;  ///< over the mean of its neighbours
};

/// The strongest lines of a white sequence beyond what chance makes of it.
struct SpectralLines {
  std::vector<SpectralLine> lines;
  double gain = 0.0;        ///< deviance that they take; 0 where there is none
  double resolution = 0.0;  ///< cycles per sample
  double noise_bins = 0.0;  ///< frequencies that were looked at
};

/// `white`: of any variance.
SpectralLines find_lines(std::span<const float> white);

}  // namespace morepro::host
