#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What rings behind the feed's motion: structure with a state of its own, of which no function of what is
/// measured tells. An observer takes it for random forces, which hide it from the balance.
struct Ringing {
  double deviance = 0.0;      ///< >= 0, by which a resonance predicts the innovations beside their own past
  double means = 0.0;         ///< of innovations, up to 2000 per second, that tell it
  double frequency_hz = 0.0;  ///< 5 .. 120 Hz, below 0.15 of the means' rate; 0: none
};

/// The resonance that predicts most, driven by the feed force or by the measured motion. `fit`: of the feed.
Ringing ringing_of(const AxisFit& fit);

}  // namespace morepro::host
