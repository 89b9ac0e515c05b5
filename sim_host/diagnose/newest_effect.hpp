#pragma once
#include "sim_host/diagnose/axis_fit.hpp"

namespace morepro::host {

/// Searches for the shape of the model's newest effect, now that it acts in the model: before, the sensors'
/// noise blurs it.
void sharpen_newest(AxisFit& trial);

/// Gives the law of one of the model's effects a bend, or takes it away, where that is more likely, as far as
/// the law bends at all: a linearisation beside parameters that had to bend to what was missing does not
/// tell.
void weigh_bend(AxisFit& trial, std::size_t index);

/// Searches for when the newest effect sets in, to a hundredth of a block.
void place_onset_of_newest(AxisFit& trial);

}  // namespace morepro::host
