#pragma once
#include <cstddef>
#include <string>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/csv_header.hpp"
#include "sim_host/recording/csv_row.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/row_clock.hpp"
#include "sim_host/support/input_file.hpp"

namespace morepro::host {

/// Reads a CSV recording row by row, without allocating per row. Sequence numbers are those of RowClock.
class CsvReader {
 public:
  /// Reads the header and, for the sampling rate, the first rows.
  /// Throws UserError for everything that read_csv_header and next() refuse, and for fewer than two rows.
  explicit CsvReader(const std::string& path);

  /// The next frame; false at the end. Throws UserError where a row is malformed or time does not increase.
  bool next(SensorFrame& frame);

  [[nodiscard]] const RecordingInfo& info() const { return header_.info; }
  [[nodiscard]] const RecordingTally& tally() const { return clock_.tally(); }

 private:
  [[nodiscard]] bool has_row() const;
  void read_row();
  void infer_rate();
  void rewind();

  InputFile file_;
  CsvHeader header_;
  std::size_t offset_ = 0;
  std::size_t line_ = 0;
  CsvRow row_;
  bool is_first_row_ = true;
  double previous_time_s_ = 0.0;
  RowClock clock_;
};

}  // namespace morepro::host
