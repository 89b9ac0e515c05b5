#include "sim_host/diagnose/leftover/left_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/diagnose/leftover/spectral_lines.hpp"
#include "sim_host/support/turn.hpp"

namespace morepro::host {
namespace {

using Rows = std::vector<std::uint32_t>;

/// A sensor with its own, slower clock delivers in every so manieth row: where it does not, it would mirror
/// lines.
std::size_t stride_of(const Rows& rows) {
  std::uint32_t stride = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) stride = std::gcd(stride, rows[i] - rows[i - 1]);
  return std::max<std::size_t>(stride, 1);
}

/// White innovations at a constant rate; 0 where the sensor lacks a row.
std::vector<float> over_time(const std::vector<float>& white, const Rows& rows, std::size_t stride) {
  std::vector<float> values((rows.back() - rows.front()) / stride + 1, 0.0F);
  for (std::size_t i = 0; i < white.size(); ++i) values[(rows[i] - rows.front()) / stride] = white[i];
  return values;
}

/// So many that no instant of the sensor covers more than one of them: one in several would look like a line.
double bins_per_turn(const RecordingSignals& signals, std::size_t stride) {
  constexpr double kMostBins = 24.0;
  const double fastest_rad_s = std::max(signals.largest(Channel::kSpindleSpeed), 1.0e-9);
  return std::min(kMostBins, kTurn * signals.rate_hz / (static_cast<double>(stride) * fastest_rad_s));
}

/// White innovations over the angle of the spindle: sums over equal turns, in units of their standard
/// deviation; 0 where the sensor lacks all of it.
std::vector<float> over_angle(const std::vector<float>& white, const Rows& rows,
                              const RecordingSignals& signals, double bins_per_turn) {
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  const double bins_per_row = bins_per_turn / kTurn / signals.rate_hz;
  std::vector<float> bins;
  double filled = 0.0;  // of a bin
  double sum = 0.0;
  double count = 0.0;
  std::size_t next = 0;
  for (std::size_t row = rows.front(); row < signals.rows && next < rows.size(); ++row) {
    if (speed[row] == speed[row]) filled += std::fabs(static_cast<double>(speed[row])) * bins_per_row;
    if (rows[next] == row) {
      sum += static_cast<double>(white[next++]);
      count += 1.0;
    }
    if (filled < 1.0) continue;
    bins.push_back(static_cast<float>(sum / std::sqrt(std::max(count, 1.0))));
    filled -= 1.0;
    sum = count = 0.0;
  }
  return bins;
}

struct Sensor {
  Channel channel;
  double variance;  ///< stated
};
Sensor sensor_of(const AxisFit& fit, std::size_t sensor) {
  const auto& noise = fit.datasheet().noise;
  if (fit.axis() == Axis::kSpindle)
    return sensor == 0 ? Sensor{Channel::kSpindleSpeed, noise.speed_variance}
                       : Sensor{Channel::kArmatureCurrent, noise.current_variance};
  return sensor == 0 ? Sensor{Channel::kFeedPosition, noise.feed_position_variance}
                     : Sensor{Channel::kFeedSpeed, noise.feed_speed_variance};
}

void add_lines(const SpectralLines& found, const LeftLine& kind, double unit, std::vector<LeftLine>& lines) {
  for (const SpectralLine& line : found.lines) {
    lines.push_back(kind);
    lines.back().frequency = unit * line.cycles_per_sample;
    lines.back().resolution = unit * found.resolution;
    lines.back().power = line.power;
    lines.back().p_value = std::min(found.noise_bins * std::exp(-line.power), 1.0);
  }
}

/// What lines take in the sequence's own unit. Over its noise it is another share in each spectrum: over the
/// angle, high frequencies are averaged away.
double power_of(const SpectralLines& found) { return found.gain * found.noise; }

/// Adds the lines of one sensor; returns what they take.
double add_lines_of(const RecordingSignals& signals, const std::vector<float>& white, const Rows& rows,
                    std::size_t sensor, std::vector<LeftLine>& lines) {
  const std::size_t stride = stride_of(rows);
  const SpectralLines in_time = find_lines(over_time(white, rows, stride));
  SpectralLines in_angle;
  double bins = 0.0;
  if (signals.has(Channel::kSpindleSpeed)) {
    bins = bins_per_turn(signals, stride);
    in_angle = find_lines(over_angle(white, rows, signals, bins));
  }
  constexpr double kAlike = 1.25;  // but for what bins make of lines
  const double over_time_power = power_of(in_time);
  const double over_angle_power = power_of(in_angle);
  const bool is_order = over_angle_power > over_time_power;
  const double time_unit = signals.rate_hz / static_cast<double>(stride);
  if (kAlike * over_time_power > over_angle_power)
    add_lines(in_time, {.sensor = sensor, .is_seen_twice = is_order}, time_unit, lines);
  if (kAlike * over_angle_power > over_time_power)
    add_lines(in_angle, {.sensor = sensor, .is_order = true, .is_seen_twice = !is_order}, bins, lines);
  return std::max(in_time.gain, in_angle.gain);
}

}  // namespace

bool shows_its_steps(const AxisFit& fit, const GapStatistics& statistics, std::size_t sensor) {
  // Of the stated variance; a sensor whose noise is half a step has a quarter in its steps.
  constexpr double kMostly = 0.4;
  // A speed from two coarse positions has the variance of both.
  constexpr double kOfDifference = 2.0;
  const auto& [channel, stated] = sensor_of(fit, sensor);
  const double step = fit.signals().step[index_of(channel)];
  if (!(step * step / 12.0 > kMostly * stated)) return false;
  const auto& normalised = statistics.normalised[sensor];
  if (normalised.empty()) return false;
  const auto count = static_cast<double>(normalised.size());
  double squares = 0.0;
  for (const float value : normalised) squares += static_cast<double>(value) * static_cast<double>(value);
  return squares / count * std::exp(statistics.log_variance[sensor] / count) < kOfDifference * stated;
}

LeftLines lines_left(const AxisFit& fit, const GapStatistics& statistics) {
  const Whitening whitening = whitening_of(statistics);
  LeftLines left;
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
    if (statistics.normalised[sensor].empty() || shows_its_steps(fit, statistics, sensor)) continue;
    const auto white = white_innovations(statistics, sensor, whitening[sensor]);
    const double gain = add_lines_of(fit.signals(), white, statistics.row[sensor], sensor, left.lines);
    if (sensor == 0) left.of_first_sensor = gain;
    left.gain += gain;
  }
  return left;
}

}  // namespace morepro::host
