#pragma once
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// A frequency at which what a model leaves does not stop.
struct LeftLine {
  std::size_t sensor = 0;
  bool is_order = false;    ///< of the spindle's turn; else in Hz
  double frequency = 0.0;   ///< of either
  double resolution = 0.0;  ///< of it
  double power = 0.0;       ///< over that of the noise beside it
  double p_value = 1.0;     ///< corrected for the number of frequencies
  /// In the other spectrum, too, where it is larger: at a constant speed, a frequency is an order.
  bool is_seen_twice = false;
};

/// Are coarse steps most of a sensor's noise, and is there no more than that in `statistics`, of a pass of
/// `fit`? They follow the motion and have lines of their own, and last as long as it does not change.
bool shows_its_steps(const AxisFit& fit, const GapStatistics& statistics, std::size_t sensor);

/// Lines in what a model leaves of an axis's sensors.
struct LeftLines {
  std::vector<LeftLine> lines{};
  double gain = 0.0;             ///< deviance that they take; 0 where there are none
  double of_first_sensor = 0.0;  ///< as much of it
};

/// Over time or over the spindle's angle, which shows more; over both where they show as much. `statistics`:
/// of a pass of `fit`.
LeftLines lines_left(const AxisFit& fit, const GapStatistics& statistics);

}  // namespace morepro::host
