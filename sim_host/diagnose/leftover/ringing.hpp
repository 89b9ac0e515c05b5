#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What rings behind the feed's motion: structure with a state of its own, of which no function of what is
/// measured tells. An observer takes it for random forces, which hide it from the balance.
struct Ringing {
  double deviance = 0.0;  ///< by which a resonance predicts the innovations beside their own past
  double frequency_hz = 0.0;
};

/// The resonance that predicts most, driven by the feed force or by the measured motion: `fit` is of the feed,
/// without effects.
Ringing ringing_of(const AxisFit& fit);

}  // namespace morepro::host
