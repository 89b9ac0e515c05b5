#pragma once
#include <cstdint>
#include <string_view>

namespace morepro::host {

enum class RecordingFormat : std::uint8_t { kCsv, kNative };

/// By the file's ending, .csv or .mrec; "-" and a path without an ending (a pipe) are CSV. Throws UsageError
/// for another ending.
RecordingFormat format_of(std::string_view path);

}  // namespace morepro::host
