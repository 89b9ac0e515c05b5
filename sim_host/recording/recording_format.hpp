#pragma once
#include <cstdint>
#include <string_view>

namespace morepro::host {

enum class RecordingFormat : std::uint8_t { kCsv, kNative, kMat, kMcap };

/// The endings, for help texts.
inline constexpr std::string_view kRecordingEndings = ".csv, .mrec, .mat or .mcap";

/// By the file's ending; "-" and a path without an ending (a pipe) are CSV. Throws UsageError for another
/// ending.
RecordingFormat format_of(std::string_view path);

}  // namespace morepro::host
