#include "sim_host/recording/row_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr double kStepTolerance = 0.2;
constexpr double kRateTolerance = 1.0e-3;

double median_step_s(std::span<const double> times_s) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) steps_s.push_back(times_s[i] - times_s[i - 1]);
  return median_of(steps_s);
}

/// Does every typical step span a whole number of samples?
bool is_multiple(double steps) {
  return steps > 1.0 - kStepTolerance && std::fabs(steps - std::round(steps)) <= kStepTolerance;
}

double rate_of(std::span<const double> times_s, RecordingInfo& info) {
  const double step_s = median_step_s(times_s);
  const double found_hz = refined_rate_hz(times_s, step_s);
  if (info.metadata_value(kRateKey).empty()) return found_hz;
  const double stated_hz = info.metadata_number(kRateKey).value_or(0.0);
  const double steps = step_s * stated_hz;
  if (!is_multiple(steps)) {
    info.warnings.push_back(
        fmt::format("{}: '# {}: {}' does not fit the time steps, which give {} Hz; those are used", info.file,
                    kRateKey, info.metadata_value(kRateKey), found_hz));
    return found_hz;
  }
  const double rate_hz = refined_rate_hz(times_s, 1.0 / stated_hz);
  return std::fabs(rate_hz / stated_hz - 1.0) <= kRateTolerance ? stated_hz : rate_hz;
}

}  // namespace

RowClock::RowClock(std::span<const double> first_times_s, RecordingInfo& info) {
  info.rate_hz = rate_of(first_times_s, info);
  info.start_us = microseconds(first_times_s[0]);
  grid_ = SamplingGrid(first_times_s, info.rate_hz);
}

void RowClock::stamp(double time_s, SensorFrame& frame) {
  if (tally_.rows == 0) {
    first_time_s_ = time_s;
  } else {
    count_gap(time_s);
  }
  ++tally_.rows;
  tally_.duration_s = time_s - first_time_s_;
  previous_time_s_ = time_s;
  frame.sequence = sequence_;
  frame.time_us = wrapped(microseconds(time_s));
}

void RowClock::count_gap(double time_s) {
  const std::int64_t frames = grid_.steps_to(time_s);
  sequence_ += static_cast<std::uint32_t>(frames);
  if (frames == 1) return;
  if (tally_.gaps++ == 0) tally_.first_gap_s = previous_time_s_;
  tally_.missing_rows += static_cast<std::uint64_t>(frames - 1);
}

}  // namespace morepro::host
