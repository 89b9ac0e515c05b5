#pragma once
#include <vector>

#include "sim_host/identify/axis_identification.hpp"

namespace morepro::host {

/// The thesis's own form: two passes of the guarded filter on measured accelerations over a recording, the
/// second from what the first found. One estimate per balance that a recording holds the derivative of.
std::vector<AxisEstimate> derivative_pass(const RecordingSignals& signals,
                                          const MonitorConfiguration& configuration);

}  // namespace morepro::host
