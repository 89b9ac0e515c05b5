#pragma once
#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

/// Searches again for the widths within which dry frictions change their side that were found before the
/// model's newest effect: they had done its work, too.
void sharpen_earlier_frictions(AxisFit& fit);

}  // namespace morepro::host
