#include "sim_host/recording/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kRowsForRate = 10001;
constexpr double kStepTolerance = 0.2;
constexpr double kRateTolerance = 1.0e-3;

double median_step_s(const std::vector<double>& times_s) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps_s.push_back(times_s[i] - times_s[i - 1]);
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return *middle;
}

/// Does every typical step span a whole number of samples?
bool is_multiple(double steps) {
  return steps > 1.0 - kStepTolerance && std::fabs(steps - std::round(steps)) <= kStepTolerance;
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
  std::vector<double> times_s;
  while (times_s.size() < kRowsForRate && has_row()) {
    read_row();
    ++tally_.rows;
    times_s.push_back(row_.time_s);
    previous_time_s_ = row_.time_s;
  }
  if (times_s.size() < 2) {
    throw UserError({header_.info.file, line_, 0},
                    fmt::format("the recording has {} row(s) of data; at least two are needed", tally_.rows));
  }
  header_.info.rate_hz = rate_of(times_s);
  header_.info.start_us = microseconds(times_s[0]);
  grid_ = SamplingGrid(times_s, header_.info.rate_hz);
  tally_ = {};
  offset_ = header_.first_row_offset;
  line_ = header_.first_row_line;
}

double CsvReader::rate_of(const std::vector<double>& times_s) {
  const double step_s = median_step_s(times_s);
  const double found_hz = refined_rate_hz(times_s, step_s);
  if (header_.info.metadata_value(kRateKey).empty()) return found_hz;
  const double stated_hz = header_.info.metadata_number(kRateKey).value_or(0.0);
  const double steps = step_s * stated_hz;
  if (!is_multiple(steps)) {
    header_.info.warnings.push_back(
        fmt::format("{}: '# {}: {}' does not fit the time steps, which give {} Hz; those are used",
                    header_.info.file, kRateKey, header_.info.metadata_value(kRateKey), found_hz));
    return found_hz;
  }
  const double rate_hz = refined_rate_hz(times_s, 1.0 / stated_hz);
  return std::fabs(rate_hz / stated_hz - 1.0) <= kRateTolerance ? stated_hz : rate_hz;
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
  frame.time_us = wrapped(microseconds(row_.time_s));
  return true;
}

void CsvReader::count_gap() {
  const std::int64_t frames = grid_.steps_to(row_.time_s);
  sequence_ += static_cast<std::uint32_t>(frames);
  if (frames == 1) return;
  if (tally_.gaps++ == 0) tally_.first_gap_s = previous_time_s_;
  tally_.missing_rows += static_cast<std::uint64_t>(frames - 1);
}

}  // namespace morepro::host
