#include "sim_host/diagnose/outcome/shape_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/fit/shape_freedom.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"

namespace morepro::host {
namespace {

bool is_of_axis(const BalanceResult& balance, Axis axis) {
  return (balance.balance == gap::Balance::kFeedForce) == (axis == Axis::kFeed);
}

/// Standard error of a size, as a share of it, 0 .. 1, by what its balances keep of their gap.
double error_by_what_is_left(const Finding& finding, const AxisDiagnosis& diagnosis,
                             std::span<const BalanceResult> where) {
  const auto shows = [&](const BalanceResult& balance, const Finding& one) {
    const gap::Effect effect = one.effect.form.effect;
    return balance.is_evaluated && is_of_axis(balance, diagnosis.fit.axis()) &&
           (gap::is_in_sensor(effect) || acts_in(diagnosis.fit.signals(), balance, effect));
  };
  double before = 0.0, left = 0.0;  // power beyond noise
  for (const BalanceResult& balance : where) {
    if (!shows(balance, finding)) continue;
    double evidence = 0.0;
    for (const Finding& other : diagnosis.found)
      if (shows(balance, other)) evidence += std::max(other.evidence, 0.0);
    const double share = evidence > 0.0 ? std::max(finding.evidence, 0.0) / evidence : 1.0;
    before += share * std::max(balance.residual_ratio - 1.0, 0.0);
    left += std::max(balance.residual_ratio_after - 1.0, 0.0);
  }
  if (!(left > 0.0)) return 0.0;
  return left < before ? std::sqrt(left / before) : 1.0;
}

/// Of another simulator's names that were not the strongest of their axis and whose size was known to less
/// than three standard errors, with what shapes leave, four of five were not there; of strongest ones two
/// of 14.
void doubt_weak_name(const AxisDiagnosis& diagnosis, const Finding& finding, EffectResult& named) {
  constexpr double kLargestError = 1.0 / 3.0;  // of the size
  constexpr double kSeldomThere = 0.2;
  const bool is_strongest =
      finding.evidence >= std::ranges::max(diagnosis.found, {}, &Finding::evidence).evidence;
  if (!is_strongest && named.standard_error > kLargestError * std::fabs(named.magnitude))
    named.confidence = std::min(named.confidence, kSeldomThere);
}

/// What has no name on an axis: how many times farther than noise it may have put values. A deviance is the
/// square of a distance in standard errors.
UnnamedError error_by_unnamed(const AxisOutcome& outcome) {
  const bool is_feed = outcome.diagnosis.fit.axis() == Axis::kFeed;
  const auto motion = is_feed ? gap::Balance::kFeedForce : gap::Balance::kSpindleTorque;
  return {.of_motion = std::sqrt(outcome.unnamed_deviance_in(motion)),
          .of_voltage = std::sqrt(outcome.unnamed_deviance_in(gap::Balance::kArmatureVoltage))};
}

/// Joins what other shapes of the laws put sizes off by to their standard errors. By how much a weak name is
/// doubted was fitted without it.
void join(const FreeShapeErrors& free, const AxisFit& fit, std::span<EffectResult> which) {
  const auto& effects = fit.model().effects;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto named = std::ranges::find(which, effects[i].form.effect, &EffectResult::effect);
    if (named == which.end()) continue;
    named->standard_error = std::hypot(named->standard_error, free.of_effect[i] * named->magnitude);
  }
}

}  // namespace

bool acts_in(const RecordingSignals& signals, const BalanceResult& balance, gap::Effect effect) {
  const auto acted_on = static_cast<gap::Balance>(gap::info_of(effect).group);
  return !gap::is_in_sensor(effect) && signals.balance_that_shows(acted_on) == balance.balance;
}

std::vector<ShapeError> doubt_sizes(const AxisDiagnosis& diagnosis, std::span<const BalanceResult> where,
                                    std::span<EffectResult> which) {
  std::vector<ShapeError> by_shape;
  for (const Finding& finding : diagnosis.found) {
    const gap::Effect effect = finding.effect.form.effect;
    const double of_left = error_by_what_is_left(finding, diagnosis, where);
    const double of_noise = diagnosis.fit.relative_error_of(effect);
    by_shape.push_back({.effect = effect,
                        .of_size = std::hypot(of_left, shape_error(finding, diagnosis.fit)),
                        .of_noise = of_noise > 0.0 ? of_left / of_noise : 0.0});
    const auto named = std::ranges::find(which, effect, &EffectResult::effect);
    if (named == which.end()) continue;
    named->standard_error = std::hypot(named->standard_error, of_left * named->magnitude);
    doubt_weak_name(diagnosis, finding, *named);
  }
  return by_shape;
}

void doubt_shapes(std::span<const AxisOutcome> outcomes, DiagnosisResult& result) {
  for (const AxisOutcome& outcome : outcomes) {
    const AxisFit& fit = outcome.diagnosis.fit;
    const FreeShapeErrors free = error_by_free_shapes(fit);
    const ShapeErrors by_shape{.of_effect = doubt_sizes(outcome.diagnosis, result.where, result.which),
                               .of_value = free.of_parameter};
    join(free, fit, result.which);
    for (ParameterResult& parameter : parameters_of(fit, by_shape, error_by_unnamed(outcome)))
      result.parameters.push_back(std::move(parameter));
  }
}

}  // namespace morepro::host
