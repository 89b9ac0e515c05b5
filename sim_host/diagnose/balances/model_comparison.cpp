#include "sim_host/diagnose/balances/model_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestHorizonS = 1.0;
constexpr double kFewestHorizons = 6.0;
constexpr double kSettlingS = 0.25;
constexpr std::size_t kFewestDrawn = 4;  // of fewer pieces an interval means nothing

struct ErrorSum {
  double squares = 0.0;
  double expected = 0.0;
  double count = 0.0;
  void add(double error, double variance) {
    squares += error * error;
    expected += variance;
    count += 1.0;
  }
  void add(const ErrorSum& other) {
    squares += other.squares;
    expected += other.expected;
    count += other.count;
  }
  [[nodiscard]] double rms() const { return count > 0.0 ? std::sqrt(squares / count) : kNoError; }
  [[nodiscard]] double expected_rms() const { return count > 0.0 ? std::sqrt(expected / count) : kNoError; }
};
using HorizonErrors = std::array<ErrorSum, kSensorsPerAxis>;

/// Errors of one model, horizon by horizon.
struct ModelErrors {
  std::vector<HorizonErrors> one_step;
  std::vector<HorizonErrors> free_run;
};
using Kind = std::vector<HorizonErrors> ModelErrors::*;

/// Stretches of equal length that the recording is cut into, and how many of them in a row are held out.
struct Horizons {
  double length_s = 0.0;
  std::size_t rows = 0;      ///< of one
  std::size_t settling = 0;  ///< rows before one in which the observer settles
  std::size_t count = 0;
  std::size_t held_out = 1;

  explicit Horizons(const RecordingSignals& signals)
      : length_s(std::min(kLongestHorizonS, signals.duration_s() / kFewestHorizons)),
        rows(std::max<std::size_t>(1, static_cast<std::size_t>(length_s * signals.rate_hz))),
        settling(static_cast<std::size_t>(std::min(kSettlingS, 0.5 * length_s) * signals.rate_hz)),
        count(signals.rows / rows),
        held_out(static_cast<double>(count) >= 2.0 * kFewestHorizons ? 2 : 1) {}
  [[nodiscard]] std::size_t first(std::size_t horizon) const {
    return horizon == 0 ? settling : horizon * rows;
  }
  [[nodiscard]] std::size_t last(std::size_t horizon) const { return (horizon + 1) * rows; }
  [[nodiscard]] std::size_t parity(std::size_t horizon) const { return horizon / held_out % 2; }
};

double sensor_variance(Axis axis, const gap::GapNoise<double>& noise, std::size_t sensor) {
  if (axis == Axis::kSpindle) return sensor == 0 ? noise.speed_variance : noise.current_variance;
  return sensor == 0 ? noise.feed_position_variance : noise.feed_speed_variance;
}

/// `by_parity[k]`: the model for what was held out with parity k. The observer settles before every horizon.
ModelErrors errors_of(Axis axis, const RecordingSignals& signals, std::array<GapModel, 2> by_parity,
                      const Horizons& horizons) {
  ModelErrors errors;
  for (std::size_t h = 0; h < horizons.count; ++h) {
    GapModel& model = by_parity[horizons.parity(h)];
    const std::size_t first = horizons.first(h);
    const auto run = [&](double free_from_s) {
      HorizonErrors sum;
      model.noise.free_from_s = free_from_s;
      run_observer(axis, signals, model, first - horizons.settling, horizons.last(h),
                   [&](const Innovation& v) {
                     if (v.row < first) return;
                     const double not_taken = (model.noise.doubt(signals.time_s(v.row)) - 1.0) *
                                              sensor_variance(axis, model.noise, v.sensor);
                     sum[v.sensor].add(v.value, v.variance - not_taken);
                   });
      return sum;
    };
    errors.one_step.push_back(run(std::numeric_limits<double>::infinity()));
    errors.free_run.push_back(run(signals.time_s(first)));
  }
  return errors;
}

/// Relative to `unit`.
ModelError error_of(const std::vector<HorizonErrors>& horizons, std::size_t sensor, double unit,
                    std::uint64_t seed) {
  constexpr std::size_t kDraws = 400;
  ErrorSum all;
  for (const HorizonErrors& one : horizons) all.add(one[sensor]);
  ModelError error{.value = all.rms() / unit, .interval90 = {kNoError, kNoError}};
  if (horizons.size() < kFewestDrawn || !std::isfinite(error.value)) return error;
  std::vector<double> drawn(kDraws);
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    ErrorSum sum;
    for (std::size_t i = 0; i < horizons.size(); ++i)
      sum.add(horizons[mixed(mixed(seed, draw), i) % horizons.size()][sensor]);
    drawn[draw] = sum.rms() / unit;
  }
  std::sort(drawn.begin(), drawn.end());
  error.interval90 = {drawn[kDraws / 20], drawn[kDraws - 1 - kDraws / 20]};
  return error;
}

/// NaN where nothing moves: there is nothing to relate an error to.
double deviation_of(const RecordingSignals& signals, Channel channel) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const float value : signals.value[index_of(channel)]) {
    if (!(value == value)) continue;
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
    count += 1.0;
  }
  if (count < 2.0) return kNoError;
  const double variance = squares / count - sum * sum / (count * count);
  return variance > 0.0 ? std::sqrt(variance) : kNoError;
}

struct WatchedBalance {
  gap::Balance balance;
  std::size_t sensor;
  Channel channel;
};

std::vector<WatchedBalance> watched(Axis axis, const RecordingSignals& signals) {
  if (axis == Axis::kFeed) {
    if (signals.has(Channel::kFeedSpeed)) return {{gap::Balance::kFeedForce, 1, Channel::kFeedSpeed}};
    return {{gap::Balance::kFeedForce, 0, Channel::kFeedPosition}};
  }
  std::vector<WatchedBalance> balances{{gap::Balance::kSpindleTorque, 0, Channel::kSpindleSpeed}};
  if (signals.has_electrics())
    balances.push_back({gap::Balance::kArmatureVoltage, 1, Channel::kArmatureCurrent});
  return balances;
}

/// Models in the order of ModelComparison.
using Errors = std::array<ModelErrors, 3>;

Errors errors_of(const AxisDiagnosis& diagnosis, const Horizons& horizons) {
  const AxisFit& fit = diagnosis.fit;
  const auto of = [&](std::array<GapModel, 2> models) {
    for (GapModel& model : models) model.noise = fit.model().noise;
    return errors_of(fit.axis(), fit.signals(), std::move(models), horizons);
  };
  const auto of_fit = [&](const AxisFit& one) {
    return of(one.cross_fitted(horizons.length_s, horizons.held_out));
  };
  Errors errors{of({fit.datasheet(), fit.datasheet()}), of_fit(diagnosis.nominal), {}};
  errors.back() = diagnosis.found.empty() ? errors[1] : of_fit(fit);
  return errors;
}

/// What the observer of the model with effects expects: of its sensor, and of what the machine does at
/// random.
double floor_of(const Errors& errors, Kind kind, std::size_t sensor) {
  ErrorSum sum;
  for (const HorizonErrors& one : errors.back().*kind) sum.add(one[sensor]);
  return sum.expected_rms();
}

}  // namespace

double horizon_s(const RecordingSignals& signals) { return Horizons(signals).length_s; }

void compare_models(const AxisDiagnosis& diagnosis, std::uint64_t seed, Shrinkage& shrinkage) {
  const AxisFit& fit = diagnosis.fit;
  const Horizons horizons(fit.signals());
  const Errors errors = errors_of(diagnosis, horizons);
  for (const auto& [balance, sensor, channel] : watched(fit.axis(), fit.signals())) {
    const double unit = deviation_of(fit.signals(), channel);
    const auto compare = [&, sensor = sensor](Kind kind) {
      const auto error = [&](const ModelErrors& model) { return error_of(model.*kind, sensor, unit, seed); };
      ModelComparison bars{error(errors[0]), error(errors[1]), error(errors[2])};
      // A sensor may be better than its machine file says: nothing is below the floor.
      bars.noise_floor = bars.sensor_floor =
          std::min(bars.with_effect.value, floor_of(errors, kind, sensor) / unit);
      if (kind == &ModelErrors::free_run) {
        const double variance = sensor_variance(fit.axis(), fit.model().noise, sensor);
        bars.sensor_floor = std::min(bars.noise_floor, std::sqrt(variance) / unit);
      }
      return bars;
    };
    const auto place = static_cast<std::size_t>(balance);
    shrinkage.one_step_nrmse[place] = compare(&ModelErrors::one_step);
    shrinkage.free_run_nrmse[place] = compare(&ModelErrors::free_run);
  }
}

}  // namespace morepro::host
