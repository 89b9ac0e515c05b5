#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "lib/monitor/monitor_configuration.hpp"
#include "lib/wire/record.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/support/file_window.hpp"

namespace morepro::host {

/// Whether a native recording is whole, and what of it can be read.
struct NativeIntegrity {
  std::uint64_t frames = 0;     ///< that can be read
  wire::CorruptCounts corrupt;  ///< pieces that are no record, by cause
  std::uint64_t first_corrupt_offset =
      0;                             ///< byte where the first of them begins; meaningful where there is one
  bool has_end = false;              ///< the last record is an end record: the writer finished
  std::uint32_t frames_written = 0;  ///< as the end record says, wraps; meaningful where has_end
  std::uint64_t cut_offset = 0;      ///< byte behind the last whole record

  /// Nothing was cut off, nothing is damaged, no frame is missing.
  [[nodiscard]] bool is_complete() const {
    return has_end && corrupt.total() == 0 && frames_written == static_cast<std::uint32_t>(frames);
  }
};

/// A whole native recording, looked through once.
struct NativeScan {
  RecordingInfo info;
  NativeIntegrity integrity;
  std::optional<MonitorConfiguration> configuration;  ///< the first one that the recording holds
};

/// Looks through `bytes` to their end; `file` is its name for sentences. Corrupt places and a missing end
/// become warnings. Throws UserError where not a single record is found.
NativeScan scan_native(const std::string& file, FileWindow& bytes);

}  // namespace morepro::host
