#include "sim_host/diagnose/shrinkage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr double kOneSided95 = 1.645;
// No catalogue has a machine's exact shapes. Of the excess an effect of another shape leaves this much on
// average, and hardly ever more than that.
constexpr double kUsualMisfit = 0.02;
constexpr double kLargestMisfit = 0.10;
using Chosen = std::vector<std::size_t>;

/// `floor`: the noise floor of each balance as a share of what the effects leave.
double share_of(std::span<const BalanceRows> balances, std::span<const double> floor,
                const std::vector<Chosen>& chosen) {
  double closed = 0.0;
  double open = 0.0;
  for (std::size_t b = 0; b < balances.size(); ++b) {
    for (const std::size_t i : chosen[b]) {
      const double before = balances[b].held_out_before[i];
      const double after = balances[b].held_out_after[i];
      closed += before - after;
      open += before - after * floor[b];
    }
  }
  return open > 0.0 ? std::clamp(closed / open, -1.0, 1.0) : 0.0;
}

struct ErrorSum {
  double squares = 0.0;
  double expected = 0.0;
  double count = 0.0;
  void add(const Innovation& v) {
    squares += v.value * v.value;
    expected += v.variance;
    count += 1.0;
  }
  [[nodiscard]] double rms() const { return count > 0.0 ? std::sqrt(squares / count) : kNone; }
  [[nodiscard]] double expected_rms() const { return count > 0.0 ? std::sqrt(expected / count) : kNone; }
};
using AxisErrors = std::array<ErrorSum, kSensorsPerAxis>;

AxisErrors one_step_errors(Axis axis, const RecordingSignals& signals, const GapModel& model) {
  AxisErrors errors;
  run_observer(axis, signals, model, {}, 0, signals.rows,
               [&errors](const Innovation& v) { errors[v.sensor].add(v); });
  return errors;
}

/// Observers that settle before every horizon and run free over it.
AxisErrors free_run_errors(Axis axis, const RecordingSignals& signals, GapModel model, double horizon_s) {
  constexpr double kSettlingS = 0.25;
  AxisErrors errors;
  const auto length = static_cast<std::size_t>(horizon_s * signals.rate_hz);
  const auto settling = static_cast<std::size_t>(kSettlingS * signals.rate_hz);
  for (std::size_t first = settling; first + length <= signals.rows; first += length) {
    model.noise.free_from_s = signals.time_s(first);
    run_observer(axis, signals, model, {}, first - settling, first + length, [&](const Innovation& v) {
      if (v.row >= first) errors[v.sensor].add(v);
    });
  }
  return errors;
}

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
  if (count < 2.0) return kNone;
  return std::sqrt(std::max(squares / count - sum * sum / (count * count), 0.0));
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
  if (signals.has(Channel::kArmatureCurrent))
    balances.push_back({gap::Balance::kArmatureVoltage, 1, Channel::kArmatureCurrent});
  return balances;
}

}  // namespace

void share_closed(std::span<const BalanceRows> balances, std::span<const UnnamedPower> unnamed,
                  std::uint64_t seed, Shrinkage& shrinkage) {
  std::vector<double> likely;
  std::vector<double> lowest;
  std::vector<double> highest;
  std::vector<Chosen> chosen(balances.size());
  for (std::size_t b = 0; b < balances.size(); ++b) {
    const double rows = std::max(static_cast<double>(balances[b].after.size() * kRowsPerWindow), 1.0);
    const bool has_gap = !(unnamed[b].unseen == 0.0);
    const double chance = has_gap ? kOneSided95 * std::sqrt(2.0 / (kOverlap * rows)) : 0.0;
    likely.push_back(1.0 / (1.0 + unnamed[b].found / rows));
    lowest.push_back((1.0 - chance) / (1.0 + (unnamed[b].found + unnamed[b].unseen) / rows));
    highest.push_back(likely.back() * (1.0 + chance));
    chosen[b].resize(balances[b].held_out_before.size());
    std::iota(chosen[b].begin(), chosen[b].end(), 0);
  }
  shrinkage.share_closed = (1.0 - kUsualMisfit) * share_of(balances, likely, chosen);
  constexpr int kDraws = 400;
  std::vector<double> low;
  std::vector<double> high;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    std::uint64_t counter = 0;
    for (Chosen& pieces : chosen)
      for (std::size_t& piece : pieces) piece = mixed(mixed(seed, draw), counter++) % pieces.size();
    low.push_back(share_of(balances, lowest, chosen));
    high.push_back(share_of(balances, highest, chosen));
  }
  std::sort(low.begin(), low.end());
  std::sort(high.begin(), high.end());
  const double lowest_share = (1.0 - kLargestMisfit) * low[kDraws / 20];
  shrinkage.interval90 = {std::min(lowest_share, shrinkage.share_closed),
                          std::max(high[kDraws - 1 - kDraws / 20], shrinkage.share_closed)};
}

void compare_models(const AxisDiagnosis& diagnosis, Shrinkage& shrinkage) {
  const AxisFit& fit = diagnosis.fit;
  const RecordingSignals& signals = fit.signals();
  const Axis axis = fit.axis();
  const double horizon_s = std::min(1.0, 0.5 * signals.duration_s());
  shrinkage.horizon_s = horizon_s;
  const std::array<const GapModel*, 3> models{&fit.datasheet(), &diagnosis.nominal.model(), &fit.model()};
  std::array<AxisErrors, 3> step;
  std::array<AxisErrors, 3> run;
  for (std::size_t i = 0; i < models.size(); ++i) {
    GapModel model = *models[i];
    model.noise = fit.model().noise;
    step[i] = one_step_errors(axis, signals, model);
    run[i] = free_run_errors(axis, signals, model, horizon_s);
  }
  for (const WatchedBalance& balance : watched(axis, signals)) {
    const double unit = deviation_of(signals, balance.channel);
    const auto relative = [unit](double error) { return unit > 0.0 ? error / unit : kNone; };
    const auto compare = [&](const std::array<AxisErrors, 3>& errors, double floor) {
      return ModelComparison{relative(errors[0][balance.sensor].rms()),
                             relative(errors[1][balance.sensor].rms()),
                             relative(errors[2][balance.sensor].rms()), relative(floor)};
    };
    const auto place = static_cast<std::size_t>(balance.balance);
    const gap::GapNoise<double>& noise = fit.model().noise;
    const std::array<double, 2> sensor =
        axis == Axis::kSpindle ? std::array{noise.speed_variance, noise.current_variance}
                               : std::array{noise.feed_position_variance, noise.feed_speed_variance};
    // A sensor may be better than its machine file says: nothing is below the floor.
    const auto floor = [](const ErrorSum& error, double expected) { return std::min(error.rms(), expected); };
    const ErrorSum& one_step = step[2][balance.sensor];
    shrinkage.one_step_nrmse[place] = compare(step, floor(one_step, one_step.expected_rms()));
    shrinkage.free_run_nrmse[place] =
        compare(run, floor(run[2][balance.sensor], std::sqrt(sensor[balance.sensor])));
  }
}

}  // namespace morepro::host
