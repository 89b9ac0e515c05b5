#include "sim_host/recording/columns_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {

ColumnsReader::ColumnsReader(LoadedRecording recording) : recording_(std::move(recording)) {
  check_time();
  const std::span<const double> times_s(recording_.columns.time_s);
  clock_ = RowClock(times_s.first(std::min(times_s.size(), RowClock::kRowsForRate)), recording_.info);
}

void ColumnsReader::check_time() const {
  const std::string& file = recording_.info.file;
  if (rows() < 2)
    throw UserError(fmt::format("{}: the recording has {} row(s); at least two are needed", file, rows()));
  for (std::size_t row = 0; row < rows(); ++row) {
    const double time_s = recording_.columns.time_s[row];
    if (!(std::fabs(time_s) < kLongestTimeS))
      throw UserError(fmt::format(
          "{}: the time of row {} is not finite, or too large for seconds; correct or remove the row", file,
          row + 1));
    if (row > 0 && !(time_s > recording_.columns.time_s[row - 1]))
      throw UserError(
          fmt::format("{}: the time {} of row {} does not increase after {}; sort the rows or remove the "
                      "repeated one",
                      file, time_s, row + 1, recording_.columns.time_s[row - 1]));
  }
}

bool ColumnsReader::next(SensorFrame& frame) {
  if (row_ == rows()) return false;
  frame = {};
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto& values = recording_.columns.value[i];
    if (!values.empty() && !std::isnan(values[row_])) frame.set(static_cast<Channel>(i), values[row_]);
  }
  clock_.stamp(recording_.columns.time_s[row_++], frame);
  return true;
}

}  // namespace morepro::host
