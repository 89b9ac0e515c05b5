#include "sim_host/diagnose/lone_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

// What follows from what was before. An acceleration may jump and come back.
constexpr std::array kChannelsThatLast{
    Channel::kSpindleSpeed, Channel::kSpindleAngle,    Channel::kArmatureCurrent,   Channel::kFeedSpeed,
    Channel::kFeedPosition, Channel::kToolTemperature, Channel::kWindingTemperature};
constexpr double kFar = 12.0;          // standard deviations of a bend
constexpr std::size_t kReach = 16;     // rows on either side that show how much a signal bends by itself
constexpr double kMostShare = 1.0e-3;  // of the rows; more of them are structure
constexpr std::size_t kFewAnyway = 3;  // in a short recording
constexpr double kDeviation = 1.4826;  // standard deviations per median of the absolute value
constexpr double kBendDeviation = 1.224745;  // of white noise of deviation 1: sqrt(1 + 1/4 + 1/4)

/// How far a sample is from the line through its neighbours; NaN where one of the three is missing.
double bend(const std::vector<float>& column, std::size_t row) {
  if (row == 0 || row + 1 >= column.size()) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(column[row]) -
         0.5 * (static_cast<double>(column[row - 1]) + static_cast<double>(column[row + 1]));
}

/// Does a bend belong to one sample alone? Half of it, the other way, is then in both neighbours' bends: a
/// step and a kink look otherwise.
bool is_of_one_sample(const std::vector<float>& column, std::size_t row, double bend_here) {
  constexpr double kTolerance = 0.15;
  const auto is_half = [&](std::size_t neighbour) {
    return std::fabs(bend(column, neighbour) / bend_here + 0.5) < kTolerance;
  };
  return row >= 2 && is_half(row - 1) && is_half(row + 1);
}

/// Standard deviation of the bends around a row, without those that its own sample makes.
double deviation_around(const std::vector<float>& column, std::size_t row) {
  std::vector<double> bends;
  const std::size_t first = row > kReach ? row - kReach : 0;
  for (std::size_t i = first; i <= row + kReach; ++i) {
    const bool is_own = i + 1 >= row && i <= row + 1;
    const double value = std::fabs(bend(column, i));
    if (!is_own && std::isfinite(value)) bends.push_back(value);
  }
  if (bends.size() < kReach) return std::numeric_limits<double>::infinity();
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), middle, bends.end());
  return kDeviation * *middle;
}

}  // namespace

std::vector<LoneSamples> leave_out_lone_samples(RecordingSignals& signals, const Sensors& sensors) {
  const auto most =
      std::max(kFewAnyway, static_cast<std::size_t>(kMostShare * static_cast<double>(signals.rows)));
  std::vector<LoneSamples> found;
  for (const Channel channel : kChannelsThatLast) {
    const double noise = std::sqrt(sensors[channel].variance());
    if (!signals.has(channel) || !(noise > 0.0)) continue;
    std::vector<float>& column = signals.value[index_of(channel)];
    LoneSamples lone{.channel = channel};
    std::vector<std::size_t> rows;
    for (std::size_t row = 1; row + 1 < column.size(); ++row) {
      const double away = bend(column, row);
      if (!(std::fabs(away) > kFar * kBendDeviation * noise) || !is_of_one_sample(column, row, away))
        continue;
      if (!(std::fabs(away) > kFar * deviation_around(column, row))) continue;
      rows.push_back(row);
      lone.farthest = std::max(lone.farthest, std::fabs(away) / noise);
    }
    if (rows.empty() || rows.size() > most) continue;
    for (const std::size_t row : rows) column[row] = std::numeric_limits<float>::quiet_NaN();
    lone.count = rows.size();
    lone.first_row = rows.front();
    found.push_back(lone);
  }
  return found;
}

}  // namespace morepro::host
