#pragma once
#include <cstdint>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes frames as CSV: shortest digits that give the same float32 back, an empty field for a missing
/// sample. Sequence numbers are not kept: the time says which rows are missing.
class CsvWriter {
 public:
  /// `recorded`: bit_of(channel) of the columns. `start_us`: time of the first frame, of which frames hold
  /// the lower 32 bits. The file is the caller's to commit.
  CsvWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded, std::int64_t start_us);

  /// Returns false, and writes nothing, where the frame's time is not after the one before.
  bool write(const SensorFrame& frame);

 private:
  OutputFile& file_;
  std::uint16_t recorded_;
  IncreasingTime time_;
};

}  // namespace morepro::host
