#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// Searches for shape and size of the model's newest effect, a dry friction, now that it acts in the model:
/// before, the sensors' noise blurs it. `widest_share` of the shape that it has is the most that it can be.
void sharpen_newest(AxisFit& trial, float widest_share);

/// The same for the dry frictions that were found before the model's newest effect: they had done its work,
/// too.
void sharpen_earlier_frictions(AxisFit& fit);

/// The same for the range of Stribeck friction that is the newest effect, with and without its bend.
void sharpen_range_of_newest(AxisFit& trial);

}  // namespace morepro::host
