#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace morepro::host {

/// "key: value" lines of a recording, in order.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Key of a native recording: the time of its first frame in seconds, where 32 bits do not hold it.
inline constexpr std::string_view kStartKey = "start_s";
/// Key: samples per second, so that rows that were dropped regularly are known to be missing.
inline constexpr std::string_view kRateKey = "rate_hz";

/// What a recording says about itself before its first frame.
struct RecordingInfo {
  std::string file;
  Metadata metadata;
  std::uint16_t recorded = 0;         ///< bit_of(channel): the recording has that signal
  double rate_hz = 0.0;               ///< sampling rate
  std::int64_t start_us = 0;          ///< time of the first frame, of which a frame holds the lower 32 bits
  std::vector<std::string> warnings;  ///< sentences for the user; nothing was lost silently

  /// The value of a metadata key; empty when the recording has none.
  [[nodiscard]] std::string_view metadata_value(std::string_view key) const {
    for (const auto& [name, value] : metadata) {
      if (name == key) return value;
    }
    return {};
  }
  /// The same as a number; empty where it is none.
  [[nodiscard]] std::optional<double> metadata_number(std::string_view key) const;
};

/// What was counted while a recording was read.
struct RecordingTally {
  std::uint64_t rows = 0;
  std::uint64_t missing_rows = 0;  ///< rows that the sampling rate lets expect and that are not there
  std::uint64_t gaps = 0;          ///< places where at least one row is missing
  double first_gap_s = 0.0;        ///< time of the row before the first gap; meaningful where gaps > 0
  double duration_s = 0.0;
};

}  // namespace morepro::host
