#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/axis_fit.hpp"

namespace morepro::host {

/// Structure in what a model leaves: how much of it is predictable, by anything.
struct Leftover {
  double gain = 0.0;     ///< deviance that nameless structure takes
  double freedom = 0.0;  ///< coefficients that it takes it with
  bool is_periodic = false;
  double torque_share = 0.0;                 ///< of the gain, spindle axis: the rest is voltage
  std::vector<gap::EffectForm> functions{};  ///< that take it, the most important one first
};

/// Smooth functions of what is measured, then lines in the spectrum over time and over the spindle's angle.
Leftover leftover_of(const AxisFit& fit, double least_evidence);

}  // namespace morepro::host
