#include "sim_host/diagnose/signals/sampling_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/gap/repeated_frames.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/differenced_speed.hpp"

namespace morepro::host {
namespace {

constexpr std::array kNoisyChannels{Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed,
                                    Channel::kFeedPosition};
constexpr std::size_t kFeedSpeed = 2;  // of these
constexpr std::size_t kFeedPosition = 3;
constexpr std::size_t kFewestStepValues = 500;
constexpr std::size_t kMostStepValues = 20000;
constexpr double kStepError = 1.0e-3;  // relative: samples are recorded with seven digits
constexpr double kCertain = 1.0e4;     // deviance: what stands in the samples is not a matter of chance

struct LostRows {
  double count = 0.0;
  std::size_t first = std::numeric_limits<std::size_t>::max();
};

/// Samples that are missing now and then. A sensor or a link that is away for a while drops none.
LostRows dropped(const std::vector<float>& column) {
  LostRows lost;
  std::size_t missing = 0;
  for (std::size_t row = 0; row <= column.size(); ++row) {
    if (row < column.size() && !(column[row] == column[row])) {
      ++missing;
      continue;
    }
    if (missing > 0 && missing <= kLongestBridge) {
      lost.count += static_cast<double>(missing);
      lost.first = std::min(lost.first, row - missing);
    }
    missing = 0;
  }
  return lost;
}

/// Rows that repeat the one before, and how many of them may be lost.
class RepeatedRows {
 public:
  explicit RepeatedRows(const RecordingSignals& signals)
      : signals_(signals), is_one_feed_sensor_(is_speed_of_position(signals)) {
    for (std::size_t row = 1; row < signals.rows; ++row)
      if (frames_.see(compare(row))) rows_.push_back(row - gap::kFramesBeside);
  }

  [[nodiscard]] double lost() const { return frames_.lost_share() * static_cast<double>(signals_.rows); }
  [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }

 private:
  [[nodiscard]] gap::SameSensors compare(std::size_t row) const {
    gap::SameSensors same;
    for (std::size_t k = 0; k < kNoisyChannels.size(); ++k) {
      const auto& column = signals_.value[index_of(kNoisyChannels[k])];
      if (column.empty() || std::isnan(column[row]) || std::isnan(column[row - 1])) continue;
      same.add(k, column[row] == column[row - 1]);
      same.is_as_before_last &= row > 1 && column[row] == column[row - 2];
    }
    if (is_one_feed_sensor_) same.join(kFeedSpeed, kFeedPosition);
    return same;
  }

  const RecordingSignals& signals_;
  bool is_one_feed_sensor_;
  gap::RepeatedFrames<double> frames_;
  std::vector<std::size_t> rows_;
};

/// The samples of a row that repeats the one before. Where its inputs do so, too, the whole row does.
void leave_out(RecordingSignals& signals, std::size_t row) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const auto repeats = [&signals, row](Channel channel) {
    const auto& column = signals.value[index_of(channel)];
    return column.empty() || column[row] == column[row - 1];
  };
  const bool is_all = repeats(Channel::kArmatureVoltage) && repeats(Channel::kFeedForce);
  for (const Channel channel : kNoisyChannels)
    if (signals.has(channel)) signals.value[index_of(channel)][row] = kNone;
  if (!is_all) return;
  for (auto& column : signals.value)
    if (!column.empty()) column[row] = kNone;
  ++signals.missing_rows;
}

/// Takes rows out that repeat the one before, where there are more of them than chance makes.
LostRows leave_out_repeated_rows(RecordingSignals& signals) {
  const RepeatedRows repeated(signals);
  if (!(repeated.lost() > 0.0)) return {};
  // The last one first: each is compared with the row before.
  for (auto row = repeated.rows().rbegin(); row != repeated.rows().rend(); ++row) leave_out(signals, *row);
  return {repeated.lost(), repeated.rows().front()};
}

/// Were as many lost from the start, hardly ever would so many have come before the first one.
bool is_late(const LostRows& lost, double rows) {
  constexpr double kHardlyEver = 14.0;  // once in a million
  const auto before = static_cast<double>(lost.first);
  return lost.count * before > kHardlyEver * (rows - before);
}

/// Of `column`, recorded in steps of `step`. Noise moves a sample that rests from step to step, so that their
/// mean is off by a sine of where between two steps the signal is, of amplitude step/pi exp(-2 (pi
/// noise/step)^2) (Widrow and Kollar, Quantization Noise, 2008).
double rounding_deviance(const std::vector<float>& column, double step, double noise) {
  double resting = 0.0;
  for (std::size_t row = 1; row < column.size(); ++row)
    if (column[row] == column[row - 1]) resting += 1.0;
  constexpr double kPi = std::numbers::pi;
  constexpr double kBesideParameters = 0.25;  // fitted values take most of it: names had up to a fifteenth
  const double amplitude = step / kPi * std::exp(-2.0 * kPi * kPi * noise * noise / (step * step));
  return kBesideParameters * resting * 0.5 * amplitude * amplitude / (noise * noise + step * step / 12.0);
}

/// Do the steps of a column hide its noise? Then it mostly shows the same as before where it moves slowly; in
/// steps of 2.5 times the noise, as many sensors have them, it does so in six of ten rows.
bool hides_noise(const std::vector<float>& column, double step) {
  constexpr double kMostly = 0.7;
  constexpr std::size_t kBeside = 8;
  double moving = 0.0;
  double same = 0.0;
  for (std::size_t row = kBeside; row + kBeside < column.size(); ++row) {
    const double moved =
        std::fabs(static_cast<double>(column[row + kBeside]) - static_cast<double>(column[row - kBeside]));
    if (!(moved > 0.5 * step && moved < 3.5 * step) || std::isnan(column[row] - column[row - 1])) continue;
    moving += 1.0;
    if (column[row] == column[row - 1]) same += 1.0;
  }
  return same > kMostly * moving;
}

struct Steps {
  double size = 0.0;
  std::size_t first_row = 0;
};

/// Steps that the samples at the end have, and the row after the last one that does not fit them.
Steps late_steps_of(const std::vector<float>& column) {
  const std::size_t count =
      std::min({column.size() / 2, std::max(column.size() / 8, kFewestStepValues), kMostStepValues});
  const std::vector<float> end(column.end() - static_cast<std::ptrdiff_t>(count), column.end());
  Steps late{.size = step_of(end), .first_row = column.size()};
  if (!(late.size > 0.0)) return {};
  const auto fits = [&late](float value) {
    const double steps = static_cast<double>(value) / late.size;
    return !(value == value) || std::fabs(steps - std::round(steps)) < 0.05 + 4.0e-7 * std::fabs(steps);
  };
  while (late.first_row > 0 && fits(column[late.first_row - 1])) --late.first_row;
  return late;
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

std::vector<SamplingFault> find_quantization(RecordingSignals& signals, Sensors& sensors,
                                             std::uint16_t assumed, std::uint16_t of_their_own) {
  std::vector<SamplingFault> faults;
  for (const Channel channel : kNoisyChannels) {
    if (!signals.has(channel) || (of_their_own & bit_of(channel)) != 0) continue;
    SensorNoise& sensor = sensors[channel];
    const auto is_coarse = [&sensor](double step) {
      return step > static_cast<double>(sensor.coarsest_step());
    };
    const auto& column = signals.value[index_of(channel)];
    Steps steps{.size = step_of(column)};
    double& coarsest = signals.step[index_of(channel)];
    coarsest = std::max(steps.size, sensor.lsb);
    if (!is_coarse(steps.size)) steps = late_steps_of(column);
    if (is_coarse(steps.size)) {
      const double ratio = steps.size / sensor.unit();
      const bool is_late = steps.first_row > column.size() / 20;
      if ((assumed & bit_of(channel)) == 0 || is_late || hides_noise(column, steps.size))
        faults.push_back({.effect = gap::Effect::kSensorQuantization,
                          .channel = channel,
                          .size = ratio,
                          .standard_error = kStepError * ratio,
                          .evidence = kCertain,
                          .onset_s = static_cast<double>(steps.first_row) / signals.rate_hz});
      sensor.lsb = coarsest = steps.size;
    }
    if (coarsest > 0.0)
      signals.rounding_deviance[index_of(channel)] = rounding_deviance(column, coarsest, sensor.noise);
  }
  return faults;
}

Sensors with_known_steps(Sensors sensors, std::span<const gap::AppliedEffect> known) {
  for (const gap::AppliedEffect& effect : known) {
    if (effect.form.effect != gap::Effect::kSensorQuantization) continue;
    for (const Channel channel : {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed})
      sensors[channel].lsb = std::max(sensors[channel].lsb, effect.coefficient[0] * sensors[channel].unit());
  }
  return sensors;
}

Sensors with_own_steps(Sensors sensors, const RecordingSignals& signals,
                       std::span<const SamplingFault> faults, std::uint16_t channels) {
  for (const Channel channel : kNoisyChannels) {
    if ((channels & bit_of(channel)) == 0) continue;
    const bool is_faulty = std::ranges::any_of(faults, [channel](const SamplingFault& fault) {
      return fault.effect == gap::Effect::kSensorQuantization && fault.channel == channel;
    });
    double& step = sensors[channel].lsb;
    if (!is_faulty) step = std::max(step, signals.step[index_of(channel)]);
  }
  return sensors;
}

void leave_out_known(std::span<const gap::AppliedEffect> known, std::vector<SamplingFault>& faults) {
  constexpr double kMoreOfIt = 1.5;
  std::erase_if(faults, [known](const SamplingFault& fault) {
    return std::any_of(known.begin(), known.end(), [&fault](const gap::AppliedEffect& effect) {
      return effect.form.effect == fault.effect && fault.size < kMoreOfIt * effect.coefficient[0];
    });
  });
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

std::optional<SamplingFault> find_dropout(RecordingSignals& signals) {
  LostRows lost;  // before rows that repeat others become holes, too
  for (const Channel channel : kNoisyChannels) {
    if (!signals.has(channel)) continue;
    if (const LostRows here = dropped(signals.value[index_of(channel)]); here.count > lost.count) lost = here;
  }
  const LostRows repeated = leave_out_repeated_rows(signals);
  lost = {lost.count + repeated.count, std::min(lost.first, repeated.first)};
  const auto rows = static_cast<double>(std::max<std::size_t>(signals.rows, 1));
  if (lost.count < GapTuning{}.lost_share * rows || lost.count > 0.9 * rows) return std::nullopt;
  const std::size_t onset = is_late(lost, rows) ? lost.first : 0;
  const double since = rows - static_cast<double>(onset);
  const double fraction = std::min(lost.count / since, 1.0);
  return SamplingFault{.effect = gap::Effect::kSampleDropout,
                       .channel = Channel::kSpindleSpeed,
                       .size = fraction,
                       .standard_error = std::sqrt(fraction * (1.0 - fraction) / since),
                       .evidence = kCertain,
                       .onset_s = static_cast<double>(onset) / signals.rate_hz};
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
