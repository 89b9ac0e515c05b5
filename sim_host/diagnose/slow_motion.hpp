#pragma once
#include <optional>

#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// A feed axis seen at about 200 Hz. Nothing where it is not recorded faster, or where means of the force over
/// these intervals would move the axis, of `mass_kg`, by more than `position_noise_m` from where the force
/// itself does: that would be another axis.
std::optional<RecordingSignals> slow_motion_of(const RecordingSignals& signals, double mass_kg,
                                               double position_noise_m);

}  // namespace morepro::host
