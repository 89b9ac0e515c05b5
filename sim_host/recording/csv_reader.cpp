#include "sim_host/recording/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kStepsForRate = 10000;

std::uint32_t wrapped_microseconds(double time_s) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(time_s * 1.0e6)));
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Written times are rounded: at 3 kHz the steps are 333 and 334 us. The mean of the ordinary steps is better
// than their median, and five digits are all that such times know.
double rate_of(std::vector<double>& steps_s) {
  const double typical_s = median(steps_s);
  double sum_s = 0.0;
  double count = 0.0;
  for (const double step_s : steps_s) {
    if (std::fabs(step_s - typical_s) > 0.05 * typical_s) continue;
    sum_s += step_s;
    count += 1.0;
  }
  const double rate_hz = count / sum_s;
  const double last_digit = std::pow(10.0, std::floor(std::log10(rate_hz)) - 4.0);
  return std::round(rate_hz / last_digit) * last_digit;
}

}  // namespace

CsvReader::CsvReader(const std::string& path) : file_(path), header_(read_csv_header(path, file_.text())) {
  offset_ = header_.first_row_offset;
  line_ = header_.first_row_line;
  infer_rate();
}

bool CsvReader::has_row() const {
  return offset_ < file_.text().size() &&
         file_.text().find_first_not_of(" \t\r\n", offset_) != std::string_view::npos;
}

void CsvReader::read_row() {
  offset_ = parse_csv_row(header_, file_.text(), offset_, line_, row_);
  if (tally_.rows > 0 && !(row_.time_s > previous_time_s_)) {
    throw UserError(
        {header_.info.file, line_, 0},
        fmt::format("time_s {} does not increase after {}; sort the rows or remove the repeated one",
                    row_.time_s, previous_time_s_));
  }
  ++line_;
}

void CsvReader::infer_rate() {
  std::vector<double> steps_s;
  while (steps_s.size() < kStepsForRate && has_row()) {
    read_row();
    if (tally_.rows++ > 0) steps_s.push_back(row_.time_s - previous_time_s_);
    previous_time_s_ = row_.time_s;
  }
  if (steps_s.empty()) {
    throw UserError({header_.info.file, line_, 0},
                    fmt::format("the recording has {} row(s) of data; at least two are needed", tally_.rows));
  }
  header_.info.rate_hz = rate_of(steps_s);
  tally_ = {};
  offset_ = header_.first_row_offset;
  line_ = header_.first_row_line;
}

bool CsvReader::next(SensorFrame& frame) {
  if (!has_row()) return false;
  read_row();
  if (tally_.rows == 0) {
    first_time_s_ = row_.time_s;
  } else {
    count_gap();
  }
  ++tally_.rows;
  tally_.duration_s = row_.time_s - first_time_s_;
  previous_time_s_ = row_.time_s;
  frame = row_.frame;
  frame.sequence = sequence_;
  frame.time_us = wrapped_microseconds(row_.time_s);
  return true;
}

void CsvReader::count_gap() {
  const double step = (row_.time_s - previous_time_s_) * header_.info.rate_hz;
  const auto frames = std::max<std::int64_t>(1, std::llround(step));
  sequence_ += static_cast<std::uint32_t>(frames);
  if (frames == 1) return;
  if (tally_.gaps++ == 0) tally_.first_gap_s = previous_time_s_;
  tally_.missing_rows += static_cast<std::uint64_t>(frames - 1);
}

}  // namespace morepro::host
