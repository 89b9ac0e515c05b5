#pragma once
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// Moments at which a sensor shows for several rows what nothing leads to: it hangs, its line is disturbed,
/// something strikes the machine. A robust fit leaves such rows out, so that no balance shows them. Samples
/// that were left out before any fit because the sensor hung count, too.
struct Bursts {
  Channel channel = Channel::kSpindleSpeed;
  std::size_t times = 0;
  std::size_t rows = 0;   ///< of all of them
  double first_s = 0.0;   ///< from where on the first one is there
  bool hangs = false;     ///< the sensor mostly repeats its last sample there
  double deviance = 0.0;  ///< that they cost
};

/// Those of each sensor that has more than noise of any kind, heavy tails included.
std::vector<Bursts> bursts_of(const AxisFit& fit);

}  // namespace morepro::host
