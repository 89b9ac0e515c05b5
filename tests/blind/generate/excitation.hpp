#pragma once
#include <vector>

#include "machine.hpp"
#include "random.hpp"

namespace blind {

/// What the controllers are asked for, one entry per sample.
struct Excitation {
  std::vector<double> spindle_reference, feed_reference, voltage_dither, force_dither;
  std::vector<double> contact, engagement, chip_load_mm;
  double winding_time_s = 3.0, tool_time_s = 0.8;
  double sample_s = 1e-4;
};

/// Reversals, dither, contact on and off, steps of chip load and engagement.
Excitation rich_excitation(const Machine& machine, double duration_s, double sample_s, Random& random);

/// Spin up, long cuts with short air gaps, feed forward and rapid return, hardly any dither.
Excitation production_excitation(const Machine& machine, double duration_s, double sample_s, Random& random);

}  // namespace blind
