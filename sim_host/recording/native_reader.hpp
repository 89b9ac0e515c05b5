#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "lib/frame/sensor_frame.hpp"
#include "lib/wire/decoder.hpp"
#include "sim_host/recording/intact_frame.hpp"
#include "sim_host/recording/native_scan.hpp"
#include "sim_host/support/file_window.hpp"

namespace morepro::host {

/// Reads a native recording (the bytes of the link, see lib/wire/README.md) frame by frame, up to a cut.
/// Damaged records are skipped and counted; records of other types are not given.
class NativeReader {
 public:
  /// Looks through the whole file once. Throws UserError where it cannot be opened or holds no record.
  explicit NativeReader(const std::string& path);

  /// The next frame; false at the end.
  bool next(SensorFrame& frame);

  [[nodiscard]] const RecordingInfo& info() const { return scan_.info; }
  [[nodiscard]] const NativeIntegrity& integrity() const { return scan_.integrity; }
  [[nodiscard]] const std::optional<MonitorConfiguration>& configuration() const {
    return scan_.configuration;
  }
  /// Damaged records skipped so far: as a live link would have reported them.
  [[nodiscard]] std::uint32_t damaged_so_far() const { return decoder_.corrupt().total(); }
  /// Of the frames read so far.
  [[nodiscard]] const RecordingTally& tally() const { return tally_; }

 private:
  void count(const SensorFrame& frame);

  FileWindow bytes_;
  NativeScan scan_;
  IntactFrame record_;
  wire::Decoder decoder_;  ///< of what is no intact frame
  RecordingTally tally_;
  std::uint32_t previous_sequence_ = 0;
  std::uint32_t previous_time_us_ = 0;
  std::uint64_t elapsed_us_ = 0;
};

}  // namespace morepro::host
