#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "sim_host/diff/aligned_frames.hpp"
#include "sim_host/diff/diff_result.hpp"
#include "sim_host/diff/tolerances.hpp"

namespace morepro::host {

/// Compares two recordings; `on_row`, where it is there, sees every aligned row in the order of time. Throws
/// UsageError where a tolerance is for a signal that neither has, UserError where a row cannot be read.
DiffResult diff_recordings(RecordingReader& a, RecordingReader& b, const Tolerances& tolerances,
                           const std::function<void(const AlignedRow&)>& on_row);

}  // namespace morepro::host
