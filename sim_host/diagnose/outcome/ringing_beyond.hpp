#pragma once
#include "sim_host/diagnose/leftover/ringing.hpp"

namespace morepro::host {

/// What rings behind the motion of a feed and predicts more than `unnamed`, a deviance, of its innovations:
/// slowly, or fast where it is not all noise. Of no deviance where chance, or a controller that sees the
/// machine's state itself, does as much.
Ringing ringing_beyond(double unnamed, const AxisFit& fit);

}  // namespace morepro::host
