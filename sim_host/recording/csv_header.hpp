#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lib/frame/channel.hpp"
#include "sim_host/recording/recording_info.hpp"

namespace morepro::host {

/// What one column of a CSV recording holds.
struct CsvColumn {
  enum class Kind : std::uint8_t { kTime, kChannel, kIgnored };
  Kind kind = Kind::kIgnored;
  Channel channel{};  ///< meaningful where kind is kChannel
  std::string name;
};

/// Everything above the first row of numbers.
struct CsvHeader {
  RecordingInfo info;              ///< without the sampling rate, which only the rows know
  std::vector<CsvColumn> columns;  ///< in the file's order
  std::size_t first_row_offset = 0;
  std::size_t first_row_line = 1;
};

/// Reads metadata lines and the header row. Throws UserError for an empty file, a missing header or time
/// column, a column that is there twice, and a header without any known signal. An unknown column gives a
/// warning.
CsvHeader read_csv_header(const std::string& file, std::string_view text);

}  // namespace morepro::host
