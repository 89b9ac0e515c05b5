#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// What rings behind the feed's motion: structure with a state of its own, of which no function of what is
/// measured tells. An observer takes it for random forces, which hide it from the balance.
struct Ringing {
  double deviance = 0.0;      ///< >= 0, by which a resonance predicts the innovations beside their own past
  double means = 0.0;         ///< of innovations that tell it
  double frequency_hz = 0.0;  ///< within the band, below 0.15 of the means' rate; 0: none
};

/// Frequencies at which something is looked for, and about how many means of innovations tell it in a second;
/// never more than there are rows.
struct RingingBand {
  double lowest_hz = 0.0;
  double highest_hz = 0.0;
  double means_per_s = 0.0;
};
inline constexpr RingingBand kSlowRinging{5.0, 120.0, 2000.0};
inline constexpr RingingBand kFastRinging{120.0, 1500.0, 10000.0};

/// The resonance that predicts most, driven by the feed force or by the measured motion. `fit`: of the feed.
Ringing ringing_of(const AxisFit& fit, const RingingBand& band = kSlowRinging);

}  // namespace morepro::host
