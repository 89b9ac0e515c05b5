#pragma once
#include <span>
#include <vector>

namespace morepro::host {

/// One frequency with its phase.
struct SpectralLine {
  double cycles_per_sample = 0.0;
  double power = 0.0;  ///< over the mean of all frequencies, lines left aside
};

/// The strongest lines of a white sequence beyond what chance makes of it, each by its strongest frequency.
struct SpectralLines {
  std::vector<SpectralLine> lines;
  double gain = 0.0;        ///< deviance that the strongest frequencies take; 0 where there is none
  double noise = 0.0;       ///< power of a frequency beside the lines
  double resolution = 0.0;  ///< cycles per sample
  double noise_bins = 0.0;  ///< frequencies that were looked at
};

/// `white`: of any variance; 0 where nothing is known, which must not come regularly.
SpectralLines find_lines(std::span<const float> white);

}  // namespace morepro::host
