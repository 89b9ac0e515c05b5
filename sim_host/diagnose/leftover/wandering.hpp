#pragma once
#include <cstddef>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What comes and goes by itself, and lasts for longer than random forces do: a load, a sensor, a flux. An
/// observer follows it as if it were such forces, so that no balance shows it.
struct Wandering {
  double deviance = 0.0;      ///< that the innovations before predict; 0: random forces do as much
  double torque_share = 0.0;  ///< of it, spindle: the rest is voltage
};

/// None where a sensor of the axis mostly shows its coarse steps, whose rounding lasts as long as a motion is
/// even, or where the observer takes a sensor's noise for forces: either is in the innovations of both.
Wandering wandering_of(const AxisFit& fit);

/// Means of innovations over that long hardly know of each other where random forces are all there is.
inline constexpr double kLongS = 0.04;

/// Rows of such a mean, 1 at least.
std::size_t rows_of_mean(double seconds, const AxisFit& fit);

}  // namespace morepro::host
