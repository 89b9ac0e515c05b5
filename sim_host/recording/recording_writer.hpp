#pragma once
#include <cstdint>
#include <variant>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/recording/csv_writer.hpp"
#include "sim_host/recording/mat_writer.hpp"
#include "sim_host/recording/mcap_writer.hpp"
#include "sim_host/recording/native_writer.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes a recording in the format that the file's ending names. The file is the caller's to commit.
class RecordingWriter {
 public:
  /// Of `info` the metadata, the recorded channels and the start are taken. A native recording begins with
  /// the configuration.
  RecordingWriter(OutputFile& file, const RecordingInfo& info, const MonitorConfiguration& configuration);

  /// Returns false, and writes nothing, where the format cannot hold the frame: only the native one holds
  /// repeated and old ones.
  bool write(const SensorFrame& frame);
  /// Closes the recording; without it a native one counts as cut.
  void finish();

 private:
  std::variant<CsvWriter, NativeWriter, MatWriter, McapWriter> writer_;
};

}  // namespace morepro::host
