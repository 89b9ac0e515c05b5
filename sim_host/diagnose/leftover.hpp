#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/axis_fit.hpp"

namespace morepro::host {

/// A frequency at which what a model leaves does not stop.
struct LeftLine {
  std::size_t sensor = 0;
  bool is_order = false;    ///< of the spindle's turn; else in Hz
  double frequency = 0.0;   ///< of either
  double resolution = 0.0;  ///< of it
  double power = 0.0;       ///< over that of the noise beside it
  double p_value = 1.0;     ///< corrected for the number of frequencies
};

/// Structure in what a model leaves: how much of it is predictable, by anything.
struct Leftover {
  double gain = 0.0;                         ///< deviance that nameless structure takes
  double freedom = 0.0;                      ///< coefficients that it takes it with
  std::vector<LeftLine> lines{};             ///< that take it where functions take less
  double torque_share = 0.0;                 ///< of the gain, spindle axis: the rest is voltage
  std::vector<gap::EffectForm> functions{};  ///< that take it, the most important one first
};

/// Smooth functions of what is measured, then lines in the spectrum over time and over the spindle's angle.
Leftover leftover_of(const AxisFit& fit, double least_evidence);

}  // namespace morepro::host
