#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes a native recording: the bytes of the link, append-only, so that a cut loses only what was not
/// written. The file is the caller's to commit, after finish().
class NativeWriter {
 public:
  /// Throws UserError where a `key: value` does not fit into a text record.
  NativeWriter(OutputFile& file, const std::vector<std::pair<std::string, std::string>>& metadata);

  /// May be repeated, so that a recording of which the beginning is lost can still be understood.
  void write(const MonitorConfiguration& configuration);
  /// Throws UserError where `present` names a channel that does not exist, or where the disk is full.
  void write(const SensorFrame& frame);
  /// Says how many frames were written: without it a reader calls the recording cut.
  void finish();

 private:
  template <class T>
  void append(const T& record);

  OutputFile& file_;
  std::uint32_t frames_ = 0;
};

}  // namespace morepro::host
