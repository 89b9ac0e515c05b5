#pragma once
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/signals/shown_noise.hpp"

namespace morepro::host {

/// Sensors that are noisier than `sensors` says by half and more: speeds and a position by what is white in
/// their samples, or, where a motion is as fast as that, in what models of the axes have left of them; so the
/// current of a winding that is slower than two rows.
std::vector<ShownNoise> noisier_sensors(const RecordingSignals& signals, const Sensors& sensors,
                                        std::span<const AxisFit* const> fits);

}  // namespace morepro::host
