#pragma once
#include <cstddef>

#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// The row from which an observer has to run so that at row `first` the bristles of the model are bent as the
/// motion before has bent them: an axis that rests there is held by what it came from. `first` without any.
std::size_t lead_of_bristles(Axis axis, const RecordingSignals& signals, const GapModel& model,
                             std::size_t first);

}  // namespace morepro::host
