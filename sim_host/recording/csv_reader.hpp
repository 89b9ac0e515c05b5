#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/csv_header.hpp"
#include "sim_host/recording/csv_row.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/sampling_grid.hpp"
#include "sim_host/support/input_file.hpp"

namespace morepro::host {

/// Reads a CSV recording row by row, without allocating per row.
/// A frame's sequence number counts the rows that the sampling rate lets expect, so that missing rows show as
/// missing frames.
class CsvReader {
 public:
  /// Reads the header and infers the sampling rate from the first 10,000 time steps: the one of the metadata
  /// where those are multiples of its step, else the one that they show.
  /// Throws UserError for everything that read_csv_header and next() refuse, and for fewer than two rows.
  explicit CsvReader(const std::string& path);

  /// The next frame; false at the end. Throws UserError where a row is malformed or time does not increase.
  bool next(SensorFrame& frame);

  [[nodiscard]] const RecordingInfo& info() const { return header_.info; }
  [[nodiscard]] const RecordingTally& tally() const { return tally_; }

 private:
  [[nodiscard]] bool has_row() const;
  void read_row();
  void infer_rate();
  double rate_of(const std::vector<double>& times_s);
  void count_gap();

  InputFile file_;
  CsvHeader header_;
  std::size_t offset_ = 0;
  std::size_t line_ = 0;
  CsvRow row_;
  double previous_time_s_ = 0.0;
  double first_time_s_ = 0.0;
  std::uint32_t sequence_ = 0;
  SamplingGrid grid_;
  RecordingTally tally_;
};

}  // namespace morepro::host
