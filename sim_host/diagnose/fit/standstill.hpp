#pragma once
#include <vector>

#include "lib/gap/gap_frame.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Does the feed axis pass standstill, and so seldom that a quarter of the recording hardly shows what
/// friction does there? One whose speed was not recorded does not.
bool passes_standstill_seldom(const RecordingSignals& signals);

/// A quarter of a long recording (`quarter_of`); of a feed axis that sets off or turns round eight times at
/// most it has all of these, since friction shows hardly anywhere else, and is longer where it has to be; all
/// of the recording where its pieces are too short for what happens there. The plain quarter where the feed's
/// speed was not recorded.
std::vector<Stretch> telling_quarter_of(Axis axis, const RecordingSignals& signals);

/// Does an axis stand still, as far as its sensors can tell? The spindle's speed, the feed's speed, or its
/// position about its mean are within their noise; where both of the feed's are recorded, the position within
/// a hundred times that. An axis without any of them does.
bool stands_still(Axis axis, const RecordingSignals& signals, const gap::GapNoise<double>& noise);

}  // namespace morepro::host
