#include "sim_host/diagnose/leftover.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/diagnose/candidate_forms.hpp"
#include "sim_host/diagnose/sampling_checks.hpp"
#include "sim_host/diagnose/spectral_lines.hpp"
#include "sim_host/diagnose/white_innovations.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostStructures = 8;

/// Functions worth the evidence, one after the other, `most` of them.
void take_functions(const AxisFit& fit, const std::vector<gap::EffectForm>& forms,
                    const GapStatistics& statistics, double least_evidence, std::size_t most,
                    Leftover& leftover) {
  const Eigen::MatrixXd moments = statistics.total();
  if (moments.size() == 0) return;
  const Eigen::Index width = moments.cols();
  std::vector<Eigen::Index> active = fit.parameter_columns();
  const auto first = static_cast<Eigen::Index>(active.size());
  const double rows = statistics.total_rows();
  double torque = 0.0;
  for (std::size_t i = 0; i < most; ++i) {
    const Remainder rest = remainder(moments, active, fit.precision(width), fit.target(width));
    double best = 0.0;
    Eigen::Index chosen = first;
    Eigen::VectorXd coefficient;
    for (Eigen::Index column = first; column < width - 1; ++column) {
      const double gain = gain_of(rest, moments, column, 1, coefficient);
      if (gain > best) {
        best = gain;
        chosen = column;
      }
    }
    const double deviance = rows * std::log(rest.rss / std::max(rest.rss - best, 1.0e-9 * rest.rss));
    if (!(deviance > least_evidence)) break;
    active.push_back(chosen);
    leftover.gain += deviance;
    leftover.freedom += 1.0;
    leftover.functions.push_back(forms[static_cast<std::size_t>(chosen - first)]);
    if (leftover.functions.back().effect == gap::Effect::kUnnamedTorque) torque += deviance;
  }
  if (leftover.gain > 0.0) leftover.torque_share = torque / leftover.gain;
}

constexpr double kTurn = 6.283185307179586;

/// That no instant covers more than one of: one in several bins would look like a line.
double bins_per_turn(const RecordingSignals& signals) {
  constexpr double kMostBins = 24.0;
  double fastest_rad_s = 0.0;
  for (const float speed : signals.value[index_of(Channel::kSpindleSpeed)])
    if (speed == speed) fastest_rad_s = std::max(fastest_rad_s, std::fabs(static_cast<double>(speed)));
  return std::min(kMostBins, kTurn * signals.rate_hz / std::max(fastest_rad_s, 1.0e-9));
}

/// White innovations over the angle of the spindle: sums over equal turns, in units of their standard
/// deviation.
std::vector<float> over_angle(const std::vector<float>& white, const RecordingSignals& signals) {
  const double bins_per_rad = bins_per_turn(signals) / kTurn;
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  std::vector<float> bins;
  double angle = 0.0;
  double sum = 0.0;
  double count = 0.0;
  const std::size_t skipped = signals.rows - std::min(signals.rows, white.size());
  for (std::size_t i = 0; i < white.size(); ++i) {
    const float w = speed.empty() ? 0.0F : speed[std::min(i + skipped, speed.size() - 1)];
    if (w == w) angle += std::fabs(static_cast<double>(w)) / signals.rate_hz * bins_per_rad;
    sum += static_cast<double>(white[i]);
    count += 1.0;
    if (angle < 1.0) continue;
    bins.push_back(static_cast<float>(sum / std::sqrt(count)));
    angle -= 1.0;
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

/// Are coarse steps most of a sensor's noise, and is there no more than that? They follow the motion and have
/// lines of their own.
bool shows_its_steps(const AxisFit& fit, const GapStatistics& statistics, std::size_t sensor) {
  // Of the stated variance; a sensor whose noise is half a step has a quarter in its steps.
  constexpr double kMostly = 0.4;
  // A speed from two coarse positions has the variance of both.
  constexpr double kOfDifference = 2.0;
  const auto& [channel, stated] = sensor_of(fit, sensor);
  const double step = step_of(fit.signals().value[index_of(channel)]);
  if (!(step * step / 12.0 > kMostly * stated)) return false;
  const auto& normalised = statistics.normalised[sensor];
  const auto count = static_cast<double>(normalised.size());
  double squares = 0.0;
  for (const float value : normalised) squares += static_cast<double>(value) * static_cast<double>(value);
  return squares / count * std::exp(statistics.log_variance[sensor] / count) < kOfDifference * stated;
}

/// `unit`: frequency, in Hz or orders, of a line that turns once per sample.
void add_lines(const SpectralLines& found, std::size_t sensor, bool is_order, double unit,
               std::vector<LeftLine>& lines) {
  for (const SpectralLine& line : found.lines)
    lines.push_back({.sensor = sensor,
                     .is_order = is_order,
                     .frequency = unit * line.cycles_per_sample,
                     .resolution = unit * found.resolution,
                     .power = line.power,
                     .p_value = std::min(found.noise_bins * std::exp(-line.power), 1.0)});
}

void look_for_lines(const AxisFit& fit, const GapStatistics& statistics, Leftover& leftover) {
  const Whitening whitening = whitening_of(statistics);
  double largest = 0.0;
  double torque = 0.0;
  std::vector<LeftLine> lines;
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
    if (statistics.normalised[sensor].empty() || shows_its_steps(fit, statistics, sensor)) continue;
    const auto white = white_innovations(statistics, sensor, whitening[sensor]);
    const SpectralLines in_time = find_lines(white);
    const SpectralLines in_angle = fit.signals().has(Channel::kSpindleSpeed)
                                       ? find_lines(over_angle(white, fit.signals()))
                                       : SpectralLines{};
    const double gain = std::max(in_time.gain, in_angle.gain);
    if (in_angle.gain > in_time.gain)
      add_lines(in_angle, sensor, true, bins_per_turn(fit.signals()), lines);
    else
      add_lines(in_time, sensor, false, fit.signals().rate_hz, lines);
    if (sensor == 0) torque = gain;
    largest += gain;
  }
  if (!(largest > leftover.gain)) return;
  leftover.torque_share = torque / largest;
  leftover.gain = largest;
  leftover.lines = std::move(lines);
}

}  // namespace

Leftover leftover_of(const AxisFit& fit, double least_evidence) {
  Leftover leftover;
  const auto forms = unnamed_forms(fit.axis(), fit.signals());
  // Mostly there is none, and that is known without what they have in common.
  GapStatistics statistics = fit.collect_with_each(forms);
  take_functions(fit, forms, statistics, least_evidence, 1, leftover);
  if (leftover.gain > 0.0) {
    leftover = {};
    statistics = fit.collect_with(forms);
    take_functions(fit, forms, statistics, least_evidence, kMostStructures, leftover);
  }
  look_for_lines(fit, statistics, leftover);
  return leftover;
}

}  // namespace morepro::host
