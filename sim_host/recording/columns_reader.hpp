#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/column_mapping.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/row_clock.hpp"

namespace morepro::host {

/// The columns of a recording, in memory.
struct RecordingColumns {
  std::vector<double> time_s;
  std::array<std::vector<float>, kChannelCount> value;  ///< NaN: a missing sample; empty: not recorded
};

/// A recording of a format that is not read row by row.
struct LoadedRecording {
  RecordingInfo info;  ///< without rate and start, which the times say
  RecordingColumns columns;
  std::string damage;  ///< what is cut off, as a sentence; empty where the file is whole
};

/// Reads a MATLAB file: one variable per column, under the column's name or mapped to it. Throws UserError
/// for everything that MatFile refuses, for a missing time, and for variables of different length.
LoadedRecording load_mat(const std::string& path, const ColumnMapping& mapping);

/// Reads an MCAP file that morepro wrote; what other topics hold is ignored with a warning. Throws UserError
/// where the file is none, has no such topic, is compressed or damaged. A cut is the damage of what is given.
LoadedRecording load_mcap(const std::string& path);

/// Gives columns as frames. NaN is a missing sample, an infinity a value, for the monitor's guard to reject.
class ColumnsReader {
 public:
  /// Throws UserError for fewer than two rows and for times that are not finite or do not increase.
  explicit ColumnsReader(LoadedRecording recording);

  /// The next frame; false at the end.
  bool next(SensorFrame& frame);

  [[nodiscard]] std::size_t rows() const { return recording_.columns.time_s.size(); }
  [[nodiscard]] const RecordingInfo& info() const { return recording_.info; }
  [[nodiscard]] const RecordingTally& tally() const { return clock_.tally(); }
  [[nodiscard]] const std::string& damage() const { return recording_.damage; }

 private:
  void check_time() const;

  LoadedRecording recording_;
  RowClock clock_;
  std::size_t row_ = 0;
};

}  // namespace morepro::host
