#include "sim_host/diagnose/signals/recording_signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

constexpr double kCalmS =
    0.004;  // over so long before and after a sample a temperature is averaged, at least
constexpr double kCalmestS = 1.0;
constexpr double kDoubtDeviations = 3.0;  // standard deviations

/// Means over samples on either side, the same number of both.
class Means {
 public:
  explicit Means(const std::vector<float>& value) : sum_(value.size() + 1), count_(value.size() + 1) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const bool is_sample = !std::isnan(value[i]);
      sum_[i + 1] = sum_[i] + (is_sample ? static_cast<double>(value[i]) : 0.0);
      count_[i + 1] = count_[i] + (is_sample ? 1 : 0);
    }
  }

  [[nodiscard]] std::size_t widest(std::size_t row) const { return std::min(row, sum_.size() - 2 - row); }
  [[nodiscard]] double samples(std::size_t row, std::size_t reach) const {
    return static_cast<double>(count_[row + reach + 1] - count_[row - reach]);
  }
  [[nodiscard]] double mean(std::size_t row, std::size_t reach) const {
    return (sum_[row + reach + 1] - sum_[row - reach]) / samples(row, reach);
  }

 private:
  std::vector<double> sum_;
  std::vector<std::uint32_t> count_;
};

/// Variance of a sensor's noise, from what a straight line through its neighbours leaves of a sample.
double noise_variance(const std::vector<float>& value) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 1; i + 1 < value.size(); ++i) {
    const double bend = static_cast<double>(value[i - 1]) - 2.0 * static_cast<double>(value[i]) +
                        static_cast<double>(value[i + 1]);
    if (std::isnan(bend)) continue;
    sum += bend * bend;
    count += 1.0;
  }
  return count > 0.0 ? sum / (6.0 * count) : 0.0;
}

/// Means over ever more samples, as long as they agree with all shorter ones (Lepski): what rests is known as
/// well as it can be, and what begins to heat is not smeared.
std::vector<float> calm(const std::vector<float>& value, double rate_hz) {
  const Means means(value);
  const double variance = noise_variance(value);
  const auto least = static_cast<std::size_t>(kCalmS * rate_hz);
  const auto most = static_cast<std::size_t>(kCalmestS * rate_hz);
  std::vector<float> result = value;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (std::isnan(value[i])) continue;
    const std::size_t widest = std::min(most, means.widest(i));
    std::size_t reach = std::min(least, widest);
    double mean = means.mean(i, reach);
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    for (;;) {
      const double doubt = kDoubtDeviations * std::sqrt(variance / means.samples(i, reach));
      lowest = std::max(lowest, mean - doubt);
      highest = std::min(highest, mean + doubt);
      reach = 2 * std::max<std::size_t>(reach, 1);
      if (reach > widest) break;
      const double wider = means.mean(i, reach);
      if (wider < lowest || wider > highest) break;
      mean = wider;
    }
    result[i] = static_cast<float>(mean);
  }
  return result;
}

/// Integral of a held input before each row; where it is missing it stays as it was.
std::vector<double> held_integral(const std::vector<float>& value, double rate_hz) {
  std::vector<double> sums;
  double sum = 0.0;
  double last = 0.0;
  for (const float sample : value) {
    sums.push_back(sum);
    if (!std::isnan(sample)) last = static_cast<double>(sample);
    sum += last / rate_hz;
  }
  return sums;
}

/// Integral of a sampled speed up to each row, by trapezoids.
std::vector<double> way(const std::vector<float>& speed, double rate_hz) {
  std::vector<double> sums = held_integral(speed, rate_hz);
  double first = std::nan("");
  double last = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!std::isnan(speed[i])) last = static_cast<double>(speed[i]);
    if (std::isnan(first) && !std::isnan(speed[i])) first = last;
    if (!std::isnan(first)) sums[i] += 0.5 * (last - first) / rate_hz;
  }
  return sums;
}

}  // namespace

double RecordingSignals::cutting_time_at(double time_s) const {
  if (cutting_time_s.empty()) return 0.0;
  const auto row = static_cast<std::size_t>(std::max(std::ceil(time_s * rate_hz) - 1.0, 0.0));
  return cutting_time_s[std::min(row, cutting_time_s.size() - 1)];
}

double RecordingSignals::first_position_m() const {
  for (const float sample : value[index_of(Channel::kFeedPosition)])
    if (!std::isnan(sample)) return static_cast<double>(sample);
  return 0.0;
}

double RecordingSignals::largest(Channel channel) const {
  double largest = 0.0;
  for (const float sample : value[index_of(channel)])
    if (!std::isnan(sample)) largest = std::max(largest, std::fabs(static_cast<double>(sample)));
  return largest;
}

bool is_missing(const RecordingSignals& signals, std::size_t row) {
  return std::all_of(signals.value.begin(), signals.value.end(), [row](const std::vector<float>& column) {
    return column.empty() || std::isnan(column[row]);
  });
}

void follow_motion(RecordingSignals& signals) {
  if (!signals.has(Channel::kSpindleAngle))
    signals.turned_rad = way(signals.value[index_of(Channel::kSpindleSpeed)], signals.rate_hz);
  if (!signals.has(Channel::kFeedPosition))
    signals.travelled_m = way(signals.value[index_of(Channel::kFeedSpeed)], signals.rate_hz);
}

void calm_temperatures(RecordingSignals& signals) {
  signals.calm_tool_degc = calm(signals.value[index_of(Channel::kToolTemperature)], signals.rate_hz);
  signals.calm_winding_degc = calm(signals.value[index_of(Channel::kWindingTemperature)], signals.rate_hz);
}

void doubt_lost_inputs(RecordingSignals& signals) {
  const auto change = [&signals](Channel channel) {
    const auto& column = signals.value[index_of(channel)];
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t row = 1; row < column.size(); ++row) {
      const double here = static_cast<double>(column[row] - column[row - 1]);
      if (!(here == here)) continue;
      squares += here * here;
      count += 1.0;
    }
    return squares / std::max(count, 1.0);
  };
  signals.lost_voltage_v2 = change(Channel::kArmatureVoltage);
  signals.lost_force_n2 = change(Channel::kFeedForce);
}

void count_cutting_time(RecordingSignals& signals) {
  signals.cutting_time_s = held_integral(signals.value[index_of(Channel::kContact)], signals.rate_hz);
}

RecordingSignals thinned(const RecordingSignals& signals, std::size_t factor) {
  RecordingSignals thin;
  thin.is_thinned = true;
  thin.rate_hz = signals.rate_hz / static_cast<double>(factor);
  thin.start_s = signals.start_s;
  thin.rows = signals.rows / factor;
  thin.missing_rows = signals.missing_rows / factor;
  thin.recorded = signals.recorded;
  thin.step = signals.step;
  thin.is_current_driven = signals.is_current_driven;
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    const auto& from = signals.value[c];
    if (from.empty()) continue;
    const bool is_input = kChannels[c].kind == ChannelKind::kHeldInput;
    for (std::size_t row = 0; row < thin.rows; ++row) {
      float sum = 0.0F;
      for (std::size_t i = 0; i < factor; ++i) sum += from[row * factor + i];
      thin.value[c].push_back(is_input ? sum / static_cast<float>(factor) : from[row * factor]);
    }
  }
  count_cutting_time(thin);
  return thin;
}

std::vector<Stretch> quarter_of(const RecordingSignals& signals) {
  constexpr std::size_t kStretches = 16;
  // A piece has to last for what it should show, too: of two seconds at 10 kHz those of 31 ms hid bristles, a
  // resonance and a constant force.
  constexpr std::size_t kFewRows = 20000, kManyRows = 40000;
  constexpr double kLongS = 8.0;
  if (signals.rows < kFewRows || (signals.rows < kManyRows && signals.duration_s() < kLongS))
    return all_of(signals);
  const std::size_t room = signals.rows / kStretches;
  const std::size_t length = room / 4;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < kStretches; ++i) {
    // At another place of each sixteenth, or a machine that repeats itself would show the same moment of its
    // cycle again and again.
    const std::size_t first = i * room + (i * 7 % kStretches) * (room - length) / kStretches;
    stretches.push_back({first, first + length});
  }
  return stretches;
}

Stretch after(const RecordingSignals& signals, double from_s) {
  const auto rows = static_cast<double>(signals.rows);
  return {static_cast<std::size_t>(std::clamp(from_s * signals.rate_hz, 0.0, rows)), signals.rows};
}

RecordingSignals beginning_of(const RecordingSignals& signals, std::size_t rows) {
  RecordingSignals beginning = signals;
  beginning.rows = std::min(rows, signals.rows);
  beginning.missing_rows = 0;
  const auto cut = [&beginning](auto& column) { column.resize(std::min(column.size(), beginning.rows)); };
  for (auto& column : beginning.value) cut(column);
  cut(beginning.calm_tool_degc);
  cut(beginning.calm_winding_degc);
  cut(beginning.cutting_time_s);
  cut(beginning.travelled_m);
  cut(beginning.turned_rad);
  for (std::size_t row = 0; row < beginning.rows; ++row)
    if (is_missing(beginning, row)) ++beginning.missing_rows;
  return beginning;
}

FrameSource::FrameSource(const RecordingSignals& signals, const MachineParameters& machine, std::size_t first,
                         Temperatures temperatures)
    : signals_(signals), row_(first), winding_degc_(kUnmeasuredWindingDegc) {
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (!signals.value[c].empty()) column_[c] = signals.value[c].data();
  const auto calm_down = [&](Channel channel, const std::vector<float>& calm) {
    const bool is_as_recorded = temperatures == Temperatures::kAsRecorded && signals.has(channel);
    if (!calm.empty() && !is_as_recorded) column_[index_of(channel)] = calm.data();
  };
  calm_down(Channel::kToolTemperature, signals.calm_tool_degc);
  calm_down(Channel::kWindingTemperature, signals.calm_winding_degc);
  input_.engagement = machine.feed.engagement;
  input_.chip_load_mm = machine.tool.chip_load_mm;
  input_.tool_temperature_degc = machine.thermal.tool_degc;
  if (first < signals.cutting_time_s.size()) cutting_time_s_ = signals.cutting_time_s[first];
}

bool FrameSource::sampled(Channel channel, double& value) const {
  const float* const column = column_[index_of(channel)];
  if (column == nullptr || std::isnan(column[row_])) return false;
  value = static_cast<double>(column[row_]);
  return true;
}

gap::GapFrame<double> FrameSource::next() {
  gap::GapFrame<double> frame;
  missing_ = signals_.missing_rows > 0 && is_missing(signals_, row_) ? missing_ + 1 : 0;
  // In registers: what is stored number by number and read again at once, as a whole, has to wait.
  PlantInput<double> input = input_;
  sampled(Channel::kArmatureVoltage, input.armature_voltage_v);
  sampled(Channel::kFeedForce, input.feed_force_n);
  sampled(Channel::kContact, input.contact);
  sampled(Channel::kEngagement, input.engagement);
  sampled(Channel::kChipLoad, input.chip_load_mm);
  sampled(Channel::kToolTemperature, input.tool_temperature_degc);
  sampled(Channel::kWindingTemperature, winding_degc_);
  frame.time_s = signals_.time_s(row_);
  frame.input = input_ = input;
  frame.winding_degc = winding_degc_;
  frame.cutting_time_s = cutting_time_s_;
  frame.has_speed = sampled(Channel::kSpindleSpeed, frame.speed_rad_s);
  frame.has_current = sampled(Channel::kArmatureCurrent, frame.current_a);
  frame.has_angle = sampled(Channel::kSpindleAngle, frame.angle_rad);
  frame.has_feed_speed = sampled(Channel::kFeedSpeed, frame.feed_speed_m_s);
  frame.has_feed_position = sampled(Channel::kFeedPosition, frame.feed_position_m);
  if (row_ < signals_.turned_rad.size()) frame.angle_rad = signals_.turned_rad[row_];
  if (row_ < signals_.travelled_m.size()) frame.feed_position_m = signals_.travelled_m[row_];
  cutting_time_s_ += input_.contact / signals_.rate_hz;
  ++row_;
  return frame;
}

}  // namespace morepro::host
