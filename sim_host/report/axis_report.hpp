#pragma once
#include <span>
#include <string>

#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/report/report_page.hpp"

namespace morepro::host {

/// A model as the page calls it.
struct NamedModel {
  std::string id;
  std::string label;
  GapModel model;
};

/// Puts one axis of a recording in memory on the page: the last of the models against what was measured, what
/// the first and the last leave, and all of them running free for `horizon_s` at a time.
void add_axis(Axis axis, const RecordingSignals& signals, std::span<const NamedModel> models,
              std::size_t most_buckets, ReportPage& page);

/// Series of one call.
inline constexpr std::size_t kSeriesPerAxis = 24;

}  // namespace morepro::host
