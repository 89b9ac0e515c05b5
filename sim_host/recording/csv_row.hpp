#pragma once
#include <cstddef>
#include <string_view>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/csv_header.hpp"

namespace morepro::host {

/// The values of one row.
struct CsvRow {
  double time_s = 0.0;
  SensorFrame frame;  ///< values and presence; sequence and time_us are the reader's
};

/// Parses the row that starts at `offset` of `text` and returns the offset of the next one. Nothing is
/// allocated. Empty fields and NaN are missing samples; an infinity is a value, for the monitor's guard to
/// reject. Throws UserError for text in a number, a wrong number of fields, and a time that is no finite
/// number.
std::size_t parse_csv_row(const CsvHeader& header, std::string_view text, std::size_t offset,
                          std::size_t line, CsvRow& row);

}  // namespace morepro::host
