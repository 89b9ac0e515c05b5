#include "sim_host/recording/csv_reader.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {

CsvReader::CsvReader(const std::string& path) : file_(path), header_(read_csv_header(path, file_.text())) {
  rewind();
  infer_rate();
  rewind();
}

void CsvReader::rewind() {
  offset_ = header_.first_row_offset;
  line_ = header_.first_row_line;
  is_first_row_ = true;
}

bool CsvReader::has_row() const {
  return offset_ < file_.text().size() &&
         file_.text().find_first_not_of(" \t\r\n", offset_) != std::string_view::npos;
}

void CsvReader::read_row() {
  offset_ = parse_csv_row(header_, file_.text(), offset_, line_, row_);
  if (!is_first_row_ && !(row_.time_s > previous_time_s_)) {
    throw UserError(
        {header_.info.file, line_, 0},
        fmt::format("time_s {} does not increase after {}; sort the rows or remove the repeated one",
                    row_.time_s, previous_time_s_));
  }
  is_first_row_ = false;
  previous_time_s_ = row_.time_s;
  ++line_;
}

void CsvReader::infer_rate() {
  std::vector<double> times_s;
  while (times_s.size() < RowClock::kRowsForRate && has_row()) {
    read_row();
    times_s.push_back(row_.time_s);
  }
  if (times_s.size() < 2) {
    throw UserError(
        {header_.info.file, line_, 0},
        fmt::format("the recording has {} row(s) of data; at least two are needed", times_s.size()));
  }
  clock_ = RowClock(times_s, header_.info);
}

bool CsvReader::next(SensorFrame& frame) {
  if (!has_row()) return false;
  read_row();
  frame = row_.frame;
  clock_.stamp(row_.time_s, frame);
  return true;
}

}  // namespace morepro::host
