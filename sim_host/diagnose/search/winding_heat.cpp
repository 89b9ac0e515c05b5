#include "sim_host/diagnose/search/winding_heat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/search/effect_search.hpp"

namespace morepro::host {
namespace {

constexpr double kHottestK = 10.0;
// A winding takes some seconds, an iron core minutes: in a recording of seconds that is the heat so far.
constexpr std::array kTimesS{1.0, 3.0, 10.0, 30.0, 600.0};
constexpr std::array kFinerFactors{1.6, 0.625, 1.25, 0.8};
constexpr int kRoundsWithoutHeat = 2;

/// The square of the current before each row, seen through a time constant, in A2.
std::vector<double> heat_of(const RecordingSignals& signals, double time_s) {
  const auto& current_a = signals.value[index_of(Channel::kArmatureCurrent)];
  const double share = -std::expm1(-1.0 / (time_s * signals.rate_hz));
  std::vector<double> heat(signals.rows, 0.0);
  double now = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < signals.rows; ++i) {
    heat[i] = now;
    if (i < current_a.size() && !std::isnan(current_a[i]))
      square = std::pow(static_cast<double>(current_a[i]), 2);
    now += share * (square - now);
  }
  return heat;
}

void warm(const std::vector<double>& heat, const WindingHeat& by, RecordingSignals& signals) {
  signals.winding_heat = by;
  signals.calm_winding_degc.resize(signals.rows);
  for (std::size_t i = 0; i < signals.rows; ++i)
    signals.calm_winding_degc[i] = static_cast<float>(kUnmeasuredWindingDegc + by.rise_k_a2 * heat[i]);
}

void warm_to_usual(double time_s, RecordingSignals& signals) {
  const std::vector<double> heat = heat_of(signals, time_s);
  const double hottest = std::max(*std::max_element(heat.begin(), heat.end()), 1.0e-300);
  warm(heat, {.time_s = time_s, .rise_k_a2 = kHottestK / hottest}, signals);
}

void warm_as_stated(const MachineParameters::Spindle& spindle, RecordingSignals& signals) {
  const WindingHeat stated{spindle.winding_time_constant_s, spindle.winding_rise_k_a2, true};
  warm(heat_of(signals, stated.time_s), stated, signals);
}

/// How much the best drift would explain beside the model of a fit to the same recording without heat.
double evidence_of_drifts(const AxisFit& without, const RecordingSignals& signals) {
  using gap::Effect;
  const std::vector<gap::EffectForm> drifts{
      {.effect = Effect::kResistanceTemperatureDrift, .kind = 0, .parts = 1, .shape = 0.0F},
      {.effect = Effect::kMagnetTemperatureDrift, .kind = 0, .parts = 1, .shape = 0.0F},
      {.effect = Effect::kMagnetTemperatureDrift, .kind = 1, .parts = 1, .shape = 0.0F}};
  AxisFit fit(Axis::kSpindle, signals, without.datasheet());
  fit.narrow_down();
  fit.change_model() = without.model();
  fit.set_whitening(without.whitening());
  const auto ranked = rank_candidates(fit, fit.collect_with_each(drifts), drifts);
  return ranked.empty() ? -1.0e300 : ranked.front().evidence;
}

}  // namespace

bool states_heat(const MachineParameters::Spindle& spindle) {
  return spindle.winding_time_constant_s > 0.0 && spindle.winding_rise_k_a2 > 0.0;
}

void heat_winding_by_current(RecordingSignals& signals, const GapModel& datasheet) {
  if (signals.has(Channel::kWindingTemperature) || !signals.has_electrics() || signals.rows == 0 ||
      !signals.has(Channel::kArmatureVoltage) || !signals.has(Channel::kSpindleSpeed))
    return;
  if (states_heat(datasheet.machine.spindle)) return warm_as_stated(datasheet.machine.spindle, signals);
  AxisFit without(Axis::kSpindle, signals, datasheet);
  without.narrow_down();
  without.settle(kRoundsWithoutHeat);
  RecordingSignals tried = signals;
  const auto evidence_with = [&](double time_s) {
    warm_to_usual(time_s, tried);
    return evidence_of_drifts(without, tried);
  };
  double best_s = kTimesS.front();
  double best = evidence_with(best_s);
  const auto try_time = [&](double time_s) {
    const double evidence = evidence_with(time_s);
    if (!(evidence > best)) return;
    best = evidence;
    best_s = time_s;
  };
  for (const double time_s : kTimesS) try_time(time_s);
  for (const double factor : kFinerFactors) try_time(factor * best_s);
  warm_to_usual(best_s, signals);
}

bool follows_heat(gap::Effect effect, const RecordingSignals& signals) {
  return !signals.has(Channel::kWindingTemperature) && (effect == gap::Effect::kResistanceTemperatureDrift ||
                                                        effect == gap::Effect::kMagnetTemperatureDrift);
}

bool has_no_size(gap::Effect effect, const RecordingSignals& signals) {
  return follows_heat(effect, signals) && !signals.winding_heat.is_stated;
}

}  // namespace morepro::host
