#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/sampling_grid.hpp"

namespace morepro::host {

/// Gives the rows of a recording that has times and no sequence numbers both: a frame's sequence number
/// counts the rows that the sampling rate lets expect, so that missing rows show as missing frames.
class RowClock {
 public:
  /// As many of the first times as the rate is inferred from.
  static constexpr std::size_t kRowsForRate = 10001;

  RowClock() = default;
  /// Sets the rate and the start of `info`: the rate of its metadata where the time steps are multiples of
  /// its step, else the one that they show, with a warning. `first_times_s`: increasing, two or more.
  RowClock(std::span<const double> first_times_s, RecordingInfo& info);

  /// Time and sequence number of the next row, whose time is after the one before.
  void stamp(double time_s, SensorFrame& frame);

  [[nodiscard]] const RecordingTally& tally() const { return tally_; }

 private:
  void count_gap(double time_s);

  SamplingGrid grid_;
  RecordingTally tally_;
  double first_time_s_ = 0.0;
  double previous_time_s_ = 0.0;
  std::uint32_t sequence_ = 0;
};

}  // namespace morepro::host
