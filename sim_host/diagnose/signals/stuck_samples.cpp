#include "sim_host/diagnose/signals/stuck_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim_host/diagnose/signals/bend.hpp"
#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kLongRun = 20;  // rows: where the noise is a whole step by chance once in 1e8
constexpr std::size_t kRowsBefore = 32;
constexpr double kBeyond = 6.0;  // standard deviations

struct Run {
  std::size_t first = 0;  ///< the sample that is repeated
  std::size_t end = 0;    ///< the row after the last repetition
};

/// None where the sensor often repeats itself, in short runs or in many long ones: it has steps.
std::vector<Run> long_runs_of(const std::vector<float>& column) {
  constexpr double kSeldom = 0.2, kFewRuns = 1.0e-3;  // of the rows
  std::vector<Run> runs;
  std::size_t repeats = 0;  // in short ones
  for (std::size_t first = 0; first < column.size();) {
    std::size_t end = first + 1;
    while (end < column.size() && column[end] == column[first]) ++end;
    if (end - first > kLongRun)
      runs.push_back({first, end});
    else
      repeats += end - first - 1;
    first = end;
  }
  const auto rows = static_cast<double>(column.size());
  const bool is_seldom = static_cast<double>(repeats) < kSeldom * rows &&
                         static_cast<double>(runs.size()) < std::max(3.0, kFewRuns * rows);
  return is_seldom ? runs : std::vector<Run>{};
}

/// Does the sensor show its noise just before? One that is sampled more slowly than the recording, or without
/// noise, repeats itself without a fault.
bool shows_noise_before(const std::vector<float>& column, std::size_t row, double noise) {
  std::vector<double> bends;
  for (std::size_t i = std::max(row, kRowsBefore) - kRowsBefore + 1; i + 1 <= row; ++i) {
    const double magnitude = std::fabs(bend(column, i));
    if (std::isfinite(magnitude)) bends.push_back(magnitude);
  }
  return bends.size() >= kRowsBefore / 2 &&
         kDeviationPerMedian / kBendDeviation * median_of(bends) > 0.5 * noise;
}

/// How far a signal goes meanwhile.
double range_of(const std::vector<float>& column, const Run& run) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t row = run.first; row < run.end; ++row) {
    if (std::isnan(column[row])) continue;
    least = std::min(least, static_cast<double>(column[row]));
    most = std::max(most, static_cast<double>(column[row]));
  }
  return most - least;
}

/// The way that the feed's speed amounts to meanwhile, in standard deviations of it and of the position.
double way_by_speed(const RecordingSignals& signals, const Run& run, const Sensors& sensors) {
  double way_m = 0.0;
  for (std::size_t row = run.first; row < run.end; ++row) {
    const double speed_m_s = signals.value[index_of(Channel::kFeedSpeed)][row];
    if (std::isfinite(speed_m_s)) way_m += speed_m_s / signals.rate_hz;
  }
  const auto rows = static_cast<double>(run.end - run.first);
  const double variance_m2 =
      sensors[Channel::kFeedPosition].variance() +
      rows * sensors[Channel::kFeedSpeed].variance() / (signals.rate_hz * signals.rate_hz);
  return std::fabs(way_m) / std::sqrt(variance_m2);
}

/// Does the axis move meanwhile, by its other sensor?
bool does_axis_move(const RecordingSignals& signals, Channel channel, const Run& run,
                    const Sensors& sensors) {
  const auto goes_far = [&](Channel beside) {
    return signals.has(beside) && range_of(signals.value[index_of(beside)], run) >
                                      2.0 * kBeyond * std::sqrt(sensors[beside].variance());
  };
  switch (channel) {
    case Channel::kSpindleSpeed:
      return goes_far(Channel::kArmatureCurrent);
    case Channel::kArmatureCurrent:
      return goes_far(Channel::kSpindleSpeed);
    case Channel::kFeedSpeed:
      return goes_far(Channel::kFeedPosition);
    default:
      return signals.has(Channel::kFeedSpeed) && way_by_speed(signals, run, sensors) > 2.0 * kBeyond;
  }
}

/// A drive shows 0 below some speed, or while it is off.
bool is_at_zero(const std::vector<float>& column, Channel channel, const Run& run, double noise) {
  return channel != Channel::kFeedPosition &&
         !(std::fabs(static_cast<double>(column[run.first])) > kBeyond * noise);
}

StuckSensor leave_out(RecordingSignals& signals, Channel channel, const Sensors& sensors) {
  constexpr double kExact = 1.0e-5;  // of the largest sample: nothing that is measured is
  std::vector<float>& column = signals.value[index_of(channel)];
  const double noise = std::max(sensors[channel].noise, kExact * signals.largest(channel));
  StuckSensor stuck{.channel = channel};
  for (const Run& run : long_runs_of(column)) {
    if (is_at_zero(column, channel, run, noise) || !shows_noise_before(column, run.first, noise) ||
        !does_axis_move(signals, channel, run, sensors))
      continue;
    if (stuck.times++ == 0) stuck.first_row = run.first + 1;
    stuck.rows += run.end - run.first - 1;
    std::fill(column.begin() + static_cast<std::ptrdiff_t>(run.first) + 1,
              column.begin() + static_cast<std::ptrdiff_t>(run.end), std::numeric_limits<float>::quiet_NaN());
  }
  return stuck;
}

}  // namespace

void leave_out_stuck_samples(RecordingSignals& signals, const Sensors& sensors) {
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition}) {
    const double step = std::max(sensors[channel].lsb, signals.step[index_of(channel)]);
    // A current that stands for the voltage is an input, not what is watched.
    const bool is_input = signals.is_current_driven && channel == Channel::kArmatureCurrent;
    if (!signals.has(channel) || is_input || !(sensors[channel].noise > step)) continue;
    if (const StuckSensor stuck = leave_out(signals, channel, sensors); stuck.rows > 0)
      signals.stuck.push_back(stuck);
  }
}

std::string sentence_of(const StuckSensor& stuck, const RecordingSignals& signals) {
  return fmt::format(
      "{} hangs: it shows one value while its axis moves, {} time{}, for {} rows in all, first at {:.4f} s; "
      "left out",
      kChannels[index_of(stuck.channel)].column, stuck.times, stuck.times == 1 ? "" : "s", stuck.rows,
      signals.start_s + signals.time_s(stuck.first_row));
}

}  // namespace morepro::host
