#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes frames as a MATLAB file of version 5: a column vector per signal under the name of its CSV column,
/// `time_s` double and the others single, NaN for a missing sample; metadata in the struct morepro_info.
/// Sequence numbers are not kept: the time says which rows are missing.
class MatWriter {
 public:
  /// `recorded`: bit_of(channel) of the columns. `start_us`: time of the first frame. The file is the
  /// caller's to commit, after finish().
  MatWriter(OutputFile& file, Metadata metadata, std::uint16_t recorded, std::int64_t start_us);

  /// Returns false, and keeps nothing, where the frame's time is not after the one before.
  bool write(const SensorFrame& frame);
  /// Throws UserError where the recording is too long for the format or the disk is full.
  void finish();

 private:
  OutputFile& file_;
  Metadata metadata_;
  std::uint16_t recorded_;
  IncreasingTime time_;
  std::vector<double> time_s_;
  std::array<std::vector<float>, kChannelCount> value_;
};

}  // namespace morepro::host
