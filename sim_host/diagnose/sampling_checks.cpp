#include "sim_host/diagnose/sampling_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

constexpr std::array kNoisyChannels{Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed,
                                    Channel::kFeedPosition};
constexpr std::size_t kMostStepValues = 20000;
constexpr double kStepError = 1.0e-3;  // relative: samples are recorded with seven digits
constexpr double kCertain = 1.0e4;     // deviance: what stands in the samples is not a matter of chance

/// Samples that are missing now and then. A sensor or a link that is away for a while drops none.
std::size_t dropped(const std::vector<float>& column) {
  std::size_t count = 0;
  std::size_t missing = 0;
  for (const float value : column) {
    const bool is_here = value == value;
    if (is_here && missing <= kLongestBridge) count += missing;
    missing = is_here ? 0 : missing + 1;
  }
  if (missing <= kLongestBridge) count += missing;
  return count;
}

/// Do two rows show the same on every sensor, on two of them at least that are finer than their noise? One
/// alone may stand still, and a coarse one repeats itself by rounding.
bool show_the_same(const RecordingSignals& signals, const Sensors& sensors, std::size_t row,
                   std::size_t other) {
  int same = 0;
  for (const Channel channel : kNoisyChannels) {
    if (!signals.has(channel)) continue;
    const auto& column = signals.value[index_of(channel)];
    if (!(column[row] == column[row]) || !(column[other] == column[other])) continue;
    if (column[row] != column[other]) return false;
    if (sensors[channel].lsb <= 0.2 * sensors[channel].noise) ++same;
  }
  return same >= 2;
}

/// Takes rows out that repeat the one before, and returns how many more there are than chance makes: samples
/// in steps are equal now and then, and then they are to those before the last one just as often.
double leave_out_repeated_rows(RecordingSignals& signals, const Sensors& sensors) {
  constexpr double kBeyondChance = 5.0;  // standard deviations, beyond twice what chance makes
  std::vector<std::size_t> repeated;
  std::size_t by_chance = 0;
  for (std::size_t row = 1; row < signals.rows; ++row) {
    if (show_the_same(signals, sensors, row, row - 1))
      repeated.push_back(row);
    else if (row >= 2 && show_the_same(signals, sensors, row, row - 2))
      ++by_chance;
  }
  const auto chance = static_cast<double>(by_chance);
  const auto count = static_cast<double>(repeated.size());
  if (!(count > 2.0 * chance + kBeyondChance * std::sqrt(chance))) return 0.0;
  for (const std::size_t row : repeated)
    for (const Channel channel : kNoisyChannels)
      if (signals.has(channel))
        signals.value[index_of(channel)][row] = std::numeric_limits<float>::quiet_NaN();
  return count - chance;
}

}  // namespace

double step_of(const std::vector<float>& column) {
  std::vector<double> values;
  for (const float value : column) {
    if (value == value) values.push_back(static_cast<double>(value));
    if (values.size() == kMostStepValues) break;
  }
  const std::size_t samples = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 4 || 2 * values.size() > samples) return 0.0;
  const double largest = std::max(std::fabs(values.front()), std::fabs(values.back()));
  const double rounding = 4.0e-7 * largest;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double difference = values[i] - values[i - 1];
    if (difference > 3.0 * rounding) step = std::min(step, difference);
  }
  if (!std::isfinite(step)) return 0.0;
  std::size_t fitting = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double steps = (values[i] - values[i - 1]) / step;
    if (std::fabs(steps - std::round(steps)) < 0.05 + 2.0 * rounding / step) ++fitting;
  }
  return 20 * fitting >= 19 * (values.size() - 1) ? step : 0.0;
}

std::vector<SamplingFault> find_quantization(const RecordingSignals& signals, Sensors& sensors) {
  std::vector<SamplingFault> faults;
  for (const Channel channel : kNoisyChannels) {
    if (!signals.has(channel)) continue;
    SensorNoise& sensor = sensors[channel];
    const double step = step_of(signals.value[index_of(channel)]);
    // A step that adds less than a tenth to the noise that is known changes nothing.
    if (!(step * step / 12.0 > sensor.lsb * sensor.lsb / 12.0 * 1.2 + 0.1 * sensor.variance())) continue;
    const double unit = sensor.lsb > 0.0 ? sensor.lsb : sensor.noise;
    faults.push_back(
        {gap::Effect::kSensorQuantization, channel, step / unit, kStepError * step / unit, kCertain});
    sensor.lsb = step;
  }
  return faults;
}

std::vector<Channel> leave_out_dead_sensors(RecordingSignals& signals, const Sensors& sensors) {
  std::vector<Channel> dead;
  for (const Channel channel : kNoisyChannels) {
    if (!signals.has(channel) || !(sensors[channel].noise > 0.5 * sensors[channel].lsb)) continue;
    auto& column = signals.value[index_of(channel)];
    float shown = std::numeric_limits<float>::quiet_NaN();
    const bool is_alive = std::any_of(column.begin(), column.end(), [&shown](float value) {
      const bool is_other = value == value && shown == shown && value != shown;
      if (value == value) shown = value;
      return is_other;
    });
    if (is_alive || signals.rows < 100) continue;
    dead.push_back(channel);
    column.clear();
    signals.recorded = static_cast<std::uint16_t>(signals.recorded & ~bit_of(channel));
  }
  return dead;
}

std::optional<SamplingFault> find_dropout(RecordingSignals& signals, const Sensors& sensors) {
  constexpr double kLeastFraction = 5.0e-4;
  std::size_t holes = 0;  // before rows that repeat others become holes, too
  for (const Channel channel : kNoisyChannels)
    if (signals.has(channel)) holes = std::max(holes, dropped(signals.value[index_of(channel)]));
  const double lost = static_cast<double>(holes) + leave_out_repeated_rows(signals, sensors);
  const double fraction = lost / static_cast<double>(std::max<std::size_t>(signals.rows, 1));
  if (fraction < kLeastFraction || fraction > 0.9) return std::nullopt;
  const double error = std::sqrt(fraction * (1.0 - fraction) / static_cast<double>(signals.rows));
  return SamplingFault{gap::Effect::kSampleDropout, Channel::kSpindleSpeed, fraction, error, kCertain};
}

double structure_left_by(const std::vector<SamplingFault>& faults) {
  // Of 2 to 30 % of all rows, 0.016 per lost one at most (simulate --effect sample_dropout, 0.1 off).
  constexpr double kPerLostRow = 0.05;
  double sum = 0.0;
  for (const SamplingFault& fault : faults)
    sum += fault.effect == gap::Effect::kSampleDropout ? kPerLostRow * fault.size
                                                       : std::numeric_limits<double>::infinity();
  return sum;
}

}  // namespace morepro::host
