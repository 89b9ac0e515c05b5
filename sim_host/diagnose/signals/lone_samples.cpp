#include "sim_host/diagnose/signals/lone_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "sim_host/diagnose/signals/bend.hpp"
#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

// What follows from what was before. An acceleration may jump and come back.
constexpr std::array kChannelsThatLast{
    Channel::kSpindleSpeed, Channel::kSpindleAngle,    Channel::kArmatureCurrent,   Channel::kFeedSpeed,
    Channel::kFeedPosition, Channel::kToolTemperature, Channel::kWindingTemperature};
constexpr double kFar = 12.0;              // standard deviations of a bend
constexpr std::size_t kReach = 16;         // rows on either side that show how much a signal bends by itself
constexpr double kMostLoneShare = 1.0e-3;  // of the rows; more of them are structure
constexpr std::size_t kFewAnyway = 3;      // in a short recording

/// Does a bend belong to one sample alone? Half of it, the other way, is then in both neighbours' bends: a
/// step and a kink look otherwise.
bool is_of_one_sample(const std::vector<float>& column, std::size_t row) {
  constexpr double kTolerance = 0.15;
  const auto is_half = [&](std::size_t neighbour) {
    return std::fabs(bend(column, neighbour) / bend(column, row) + 0.5) < kTolerance;
  };
  return is_half(row - 1) && is_half(row + 1);
}

/// Standard deviation of what a row's neighbourhood shows, without what its own sample makes of it.
template <class Value>
double deviation_around(std::size_t row, std::size_t rows, Value value_at) {
  std::vector<double> values;
  const std::size_t first = std::max<std::size_t>(row, kReach + 1) - kReach;
  for (std::size_t i = first; i <= std::min(row + kReach, rows - 1); ++i) {
    const bool is_own = i + 1 >= row && i <= row + 1;
    const double value = value_at(i);
    if (!is_own && std::isfinite(value)) values.push_back(std::fabs(value));
  }
  if (values.size() < kReach) return std::numeric_limits<double>::infinity();
  return kDeviationPerMedian * median_of(values);
}

std::optional<Channel> input_of(Channel channel) {
  switch (channel) {
    case Channel::kSpindleSpeed:
    case Channel::kArmatureCurrent:
      return Channel::kArmatureVoltage;
    case Channel::kFeedSpeed:
    case Channel::kFeedPosition:
      return Channel::kFeedForce;
    default:
      return std::nullopt;
  }
}

/// Did the input begin something else just before the row?
bool is_driven(const RecordingSignals& signals, Channel channel, std::size_t row) {
  constexpr double kUsual = 4.0;  // standard deviations of its changes around
  const auto input = input_of(channel);
  if (!input || !signals.has(*input)) return channel == Channel::kArmatureCurrent;
  const auto& column = signals.value[index_of(*input)];
  const auto change = [&column](std::size_t i) {
    return std::fabs(static_cast<double>(column[i]) - static_cast<double>(column[i - 1]));
  };
  return !(change(row - 1) <= kUsual * deviation_around(row, column.size(), change));
}

/// How far a sample is from its neighbours where it stands alone; 0 where it does not.
double alone(const RecordingSignals& signals, Channel channel, std::size_t row, double noise) {
  const std::vector<float>& column = signals.value[index_of(channel)];
  const auto bend_at = [&column](std::size_t i) { return bend(column, i); };
  const double away = std::fabs(bend_at(row));
  const bool is_candidate = away > kFar * kBendDeviation * noise && is_of_one_sample(column, row);
  if (!is_candidate || !(away > kFar * deviation_around(row, column.size(), bend_at))) return 0.0;
  return is_driven(signals, channel, row) ? 0.0 : away;
}

LoneSamples take_out_of(RecordingSignals& signals, Channel channel, double noise) {
  const auto most =
      std::max(kFewAnyway, static_cast<std::size_t>(kMostLoneShare * static_cast<double>(signals.rows)));
  std::vector<float>& column = signals.value[index_of(channel)];
  LoneSamples lone{.channel = channel};
  std::vector<std::size_t> rows;
  for (std::size_t row = 2; row + 2 < column.size(); ++row) {
    const double away = alone(signals, channel, row, noise);
    if (!(away > 0.0)) continue;
    rows.push_back(row);
    lone.farthest = std::max(lone.farthest, away / noise);
  }
  if (rows.empty() || rows.size() > most) return lone;
  for (const std::size_t row : rows) column[row] = std::numeric_limits<float>::quiet_NaN();
  lone.count = rows.size();
  lone.first_row = rows.front();
  return lone;
}

}  // namespace

std::vector<LoneSamples> leave_out_lone_samples(RecordingSignals& signals, const Sensors& sensors) {
  std::vector<LoneSamples> found;
  for (const Channel channel : kChannelsThatLast) {
    const double noise = std::sqrt(sensors[channel].variance());
    if (!signals.has(channel) || !(noise > 0.0)) continue;
    if (const LoneSamples lone = take_out_of(signals, channel, noise); lone.count > 0) found.push_back(lone);
  }
  return found;
}

std::string sentence_of(const LoneSamples& lone, const RecordingSignals& signals) {
  return fmt::format(
      "{}: {} sample{} alone, up to {:.0f} standard deviations away, the first at {:.4f} s; left out",
      kChannels[index_of(lone.channel)].column, lone.count, lone.count == 1 ? " stands" : "s stand",
      lone.farthest, signals.start_s + signals.time_s(lone.first_row));
}

}  // namespace morepro::host
