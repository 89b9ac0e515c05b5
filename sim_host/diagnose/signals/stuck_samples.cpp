#include "sim_host/diagnose/signals/stuck_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

/// A sensor, and what else moves where its axis does.
struct Watched {
  Channel channel;
  std::array<Channel, 2> beside;
};
constexpr std::array kWatched{
    Watched{Channel::kSpindleSpeed, {Channel::kArmatureCurrent, Channel::kArmatureVoltage}},
    Watched{Channel::kArmatureCurrent, {Channel::kSpindleSpeed, Channel::kArmatureVoltage}},
    Watched{Channel::kFeedSpeed, {Channel::kFeedPosition, Channel::kFeedForce}},
    Watched{Channel::kFeedPosition, {Channel::kFeedSpeed, Channel::kFeedSpeed}}};

constexpr std::size_t kLeastRows = 20;  // by chance once in 1e14, of a sensor that repeats one sample in five
constexpr double kSeldom = 0.2;
constexpr double kBeyondNoise = 6.0;  // standard deviations of a sensor

struct Run {
  std::size_t first = 0;  ///< the sample that is repeated
  std::size_t end = 0;    ///< the row after the last repetition
};

/// Long runs of one value; none where a sensor often repeats itself.
std::vector<Run> runs_of(const std::vector<float>& column) {
  std::vector<Run> runs;
  std::size_t repeats = 0;  // in short ones
  for (std::size_t first = 0; first < column.size();) {
    std::size_t end = first + 1;
    while (end < column.size() && column[end] == column[first]) ++end;
    if (end - first > kLeastRows)
      runs.push_back({first, end});
    else
      repeats += end - first - 1;
    first = end;
  }
  if (static_cast<double>(repeats) > kSeldom * static_cast<double>(column.size())) runs.clear();
  return runs;
}

/// Does a signal go farther than its noise does meanwhile? `noise`: 0 where none is known, of an input that
/// is exact.
bool moves(const RecordingSignals& signals, Channel channel, const Run& run, double noise) {
  if (!signals.has(channel)) return false;
  const auto& column = signals.value[index_of(channel)];
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t row = run.first; row < run.end; ++row) {
    if (std::isnan(column[row])) continue;
    least = std::min(least, static_cast<double>(column[row]));
    most = std::max(most, static_cast<double>(column[row]));
  }
  return most - least > 2.0 * kBeyondNoise * noise;
}

/// Something that rests shows one value, too: the sensor of a drive that shows 0 below some speed.
bool is_away_from_rest(const std::vector<float>& column, Channel channel, const Run& run, double noise) {
  const auto held = static_cast<double>(column[run.first]);
  if (channel != Channel::kFeedPosition && std::fabs(held) > kBeyondNoise * noise) return true;
  return run.end < column.size() &&
         std::fabs(static_cast<double>(column[run.end]) - held) > kBeyondNoise * noise;
}

StuckSensor leave_out(RecordingSignals& signals, const Watched& watched, const Sensors& sensors) {
  std::vector<float>& column = signals.value[index_of(watched.channel)];
  const double noise = sensors[watched.channel].noise;
  StuckSensor stuck{.channel = watched.channel};
  for (const Run& run : runs_of(column)) {
    const bool does_axis_move = std::ranges::any_of(watched.beside, [&](Channel channel) {
      return moves(signals, channel, run, std::sqrt(sensors[channel].variance()));
    });
    if (!does_axis_move || !is_away_from_rest(column, watched.channel, run, noise)) continue;
    if (stuck.times++ == 0) stuck.first_row = run.first + 1;
    stuck.rows += run.end - run.first - 1;
    std::fill(column.begin() + static_cast<std::ptrdiff_t>(run.first) + 1,
              column.begin() + static_cast<std::ptrdiff_t>(run.end), std::numeric_limits<float>::quiet_NaN());
  }
  return stuck;
}

}  // namespace

void leave_out_stuck_samples(RecordingSignals& signals, const Sensors& sensors) {
  for (const Watched& watched : kWatched) {
    const double step = std::max(sensors[watched.channel].lsb, signals.step[index_of(watched.channel)]);
    if (!signals.has(watched.channel) || !(sensors[watched.channel].noise > 0.5 * step)) continue;
    if (const StuckSensor stuck = leave_out(signals, watched, sensors); stuck.rows > 0)
      signals.stuck.push_back(stuck);
  }
}

std::string sentence_of(const StuckSensor& stuck, const RecordingSignals& signals) {
  return fmt::format(
      "{} hangs: it shows one value while its axis moves, {} time{}, for {} rows in all, first at "
      "{:.4f} s; left out",
      kChannels[index_of(stuck.channel)].column, stuck.times, stuck.times == 1 ? "" : "s", stuck.rows,
      signals.start_s + signals.time_s(stuck.first_row));
}

}  // namespace morepro::host
