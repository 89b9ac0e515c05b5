#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "hal/board.hpp"
#include "sim_host/recording/columns_reader.hpp"
#include "sim_host/recording/csv_reader.hpp"
#include "sim_host/recording/native_reader.hpp"

namespace morepro::host {

/// A recording of any format, read as a board reads its link.
class RecordingReader {
 public:
  /// The format is that of the file's ending; `mapping` is for those whose columns may have names of their
  /// own
  /// (.mat). Throws UserError where the file cannot be read at all, UsageError for a mapping that it cannot
  /// take.
  explicit RecordingReader(const std::string& path, const ColumnMapping& mapping = {});

  /// kFrame, kCorrupt for a damaged place of a native recording, kEnd. Throws UserError at a malformed CSV
  /// row.
  hal::ReadStatus next(SensorFrame& frame);

  [[nodiscard]] const RecordingInfo& info() const;
  [[nodiscard]] const RecordingTally& tally() const;  ///< of the frames read so far
  /// The machine that a native recording holds.
  [[nodiscard]] std::optional<MonitorConfiguration> configuration() const;
  /// What is damaged or cut off, as a sentence; empty where the recording is whole.
  [[nodiscard]] std::string damage() const;
  /// 0: not known before the end.
  [[nodiscard]] std::uint64_t frame_count() const;

 private:
  hal::ReadStatus next_native(NativeReader& reader, SensorFrame& frame);

  std::variant<CsvReader, NativeReader, ColumnsReader> reader_;
  std::optional<SensorFrame> held_;  ///< read already, waits until the damage before it is reported
  std::uint32_t damage_reported_ = 0;
};

}  // namespace morepro::host
