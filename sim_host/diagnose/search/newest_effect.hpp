#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// Lets the model's newest effect, dry friction of the spindle, bend before it slides, where that is more
/// likely.
void weigh_bristle(AxisFit& trial);

/// Searches for how far the bristle of the model's newest effect, a slide's, yields.
void tune_bristle(AxisFit& trial);

/// Searches for the width of the model's newest effect, a play, beside everything that it has bent before.
void tune_play(AxisFit& trial);

/// Searches for resonance and damping of the model's newest effect, a compliant shaft, now that it swings in
/// the model; to the end where it is likelier than the `rival`.
void tune_newest(AxisFit& trial, double rival);

/// Gives the law of one of the model's effects a bend, or takes it away, where that is more likely, as far as
/// the law bends at all: a linearisation beside parameters that had to bend to what was missing does not
/// tell.
void weigh_bend(AxisFit& trial, std::size_t index);

/// Is friction that depends on the direction bent so far between rest and the fastest speed of a recording
/// that it is another law? Other effects are not. `reference_m_s`: the speed at which its size is stated.
bool bends_too_far(const gap::AppliedEffect& effect, double fastest_m_s, double reference_m_s);

/// Exchanges the newest effect, a drive's lag, with the axis's own, where that is more likely: two in a row
/// do nearly the same in either order, and no way leads from one to the other.
void weigh_order_of_lags(AxisFit& trial);

/// Searches for when the newest effect sets in, to a hundredth of a block.
void place_onset_of_newest(AxisFit& trial);

}  // namespace morepro::host
