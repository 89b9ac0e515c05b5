#include "sim_host/recording/recording_format.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {

RecordingFormat format_of(std::string_view path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".mrec") return RecordingFormat::kNative;
  if (ending == ".mat") return RecordingFormat::kMat;
  if (ending == ".mcap") return RecordingFormat::kMcap;
  if (ending == ".csv" || ending.empty()) return RecordingFormat::kCsv;
  throw UsageError(fmt::format("{}: '{}' is no recording format; use {}", path, ending, kRecordingEndings));
}

}  // namespace morepro::host
