#include "sim_host/diagnose/search/effect_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/dry_friction.hpp"
#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/fit/shape_freedom.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/friction_shape.hpp"
#include "sim_host/diagnose/search/newest_effect.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr double kBent = 0.6;     // relative deviation of a parameter that no datasheet has
constexpr float kNoWider = 1.0F;  // share of the shape that a linearisation shows

// Of the evidence that a linearisation promises for all of a recording: what a part of a quarter of it shows
// at least where a trial has come to its end.
constexpr double kKept = 0.1;

/// The effect as a fit begins with it: of no size, so that parameters and size move together. A lag or a
/// delay has no such beginning; it starts with the size that was found.
gap::AppliedEffect beginning_of(const Candidate& candidate) {
  gap::AppliedEffect effect{.form = candidate.form, .coefficient = {}, .onset_s = candidate.onset_s};
  if (gap::size_is_shape(effect.form.effect) && effect.form.parts == 1) effect.coefficient[0] = 1.0;
  return effect;
}

/// Where a noisy speed changes its sign all the time, the width in which friction does so looks too wide.
constexpr bool has_blurred_shape(const gap::EffectForm& form) {
  return gap::is_dry_friction(form) && !gap::is_stribeck(form.effect);
}

/// How much the second part of a law is of its first where its cause is largest, of those that have no second
/// part where there is no cause.
double bend_at_most(const gap::EffectForm& form, const AxisFit& fit) {
  switch (form.effect) {
    case gap::Effect::kFeedForceSaturation:
    case gap::Effect::kTorqueConstantSaturation:
    case gap::Effect::kToolWearRamp:
      return largest_bend(form, fit);
    default:
      return 0.0;
  }
}

/// Would a drive or a motor that saturates push the other way at something that the recording asks of it? It
/// loses a share of that, which is the first part of its law times the square and the bend times the fourth
/// power. A little more than all of it may be what two parts make of a hard limit.
bool turns_round(const gap::AppliedEffect& effect, const AxisFit& fit) {
  constexpr double kMostLost = 1.2;
  const gap::Effect own = effect.form.effect;
  const bool is_drive = own == gap::Effect::kFeedForceSaturation;
  if (!is_drive && own != gap::Effect::kTorqueConstantSaturation) return false;
  const double most = fit.signals().largest(is_drive ? Channel::kFeedForce : Channel::kArmatureCurrent);
  const double first = effect.coefficient[0] * most * most;
  const double bend =
      effect.form.parts > 1 ? effect.coefficient[1] * bend_at_most(effect.form, fit) * most * most : 0.0;
  const bool peaks_before = first > 0.0 && bend < 0.0 && first < -2.0 * bend;
  return std::max(first + bend, peaks_before ? -first * first / (4.0 * bend) : 0.0) > kMostLost;
}

/// Are they the same, or parts of one friction of the same axis?
bool is_of_one_kind(gap::Effect a, gap::Effect b) {
  const Family family = family_of(a);
  return a == b ||
         (family != Family::kNone && family == family_of(b) && gap::is_of_feed(a) == gap::is_of_feed(b));
}

/// The model with one effect more, fitted to a part of the recording.
AxisFit roughly_fitted(const AxisFit& fit, const Candidate& candidate, const AxisFit::Rival& without,
                       bool is_astray) {
  std::vector<AxisFit> trials{fit};
  if (is_astray) trials.push_back(at_datasheet(fit));
  in_parallel(trials.size(), [&](std::size_t i) {
    trials[i].change_model().effects.push_back(beginning_of(candidate));
    trials[i].settle_roughly(kDuelRounds, without);
  });
  AxisFit best =
      trials.back().unlikeliness() < trials.front().unlikeliness() ? trials.back() : trials.front();
  if (without.in_part - best.unlikeliness() > kKept * candidate.evidence) return best;
  AxisFit trusting = at_datasheet(fit);
  trusting.change_model().effects.push_back(beginning_of(candidate));
  trusting.expect_noise(kTrustingNoiseShare);
  trusting.settle_roughly(kDuelRounds, without);
  return trusting.unlikeliness() < best.unlikeliness() ? trusting : best;
}

EffectTrial tried(const AxisFit& fit, const Candidate& candidate, AxisFit::Rival without, bool is_astray) {
  if (keeps_its_side(candidate.form.effect)) without.in_part = AxisFit::kNone;
  EffectTrial trial{refined(fit, candidate), fit};
  trial.fit = roughly_fitted(fit, trial.candidate, without, is_astray);
  trial.fit.finish(without);
  weigh_order_of_lags(trial.fit);
  const bool is_far_behind = trial.fit.unlikeliness() > without.far_behind;
  if (has_blurred_shape(candidate.form) && !is_far_behind) sharpen_newest(trial.fit, kNoWider);
  if (candidate.form.effect == gap::Effect::kSpindleCoulombFriction) weigh_bristle(trial.fit);
  if (candidate.form.effect == gap::Effect::kFeedPresliding) tune_bristle(trial.fit);
  if (candidate.form.effect == gap::Effect::kFeedBacklash) tune_play(trial.fit);
  // A bend would do the work of a wrong onset.
  if (candidate.onset_s > 0.0) place_onset_of_newest(trial.fit);
  if (candidate.form.effect == gap::Effect::kShaftCompliance) tune_newest(trial.fit, without.everywhere);
  weigh_bend(trial.fit, trial.fit.model().effects.size() - 1);
  trial.candidate.form = trial.fit.model().effects.back().form;
  return trial;
}

}  // namespace

// Before the first cut nothing swings, and a resonance that is not yet tuned does best without its first
// swing, from where it is tuned to what it has lost.
EffectTrial try_effect(const AxisFit& fit, const Candidate& candidate, const AxisFit::Rival& without,
                       bool is_astray) {
  EffectTrial trial = tried(fit, candidate, without, is_astray);
  if (candidate.form.effect != gap::Effect::kShaftCompliance || !(candidate.onset_s > 0.0)) return trial;
  Candidate early = candidate;
  early.onset_s = 0.0;
  EffectTrial from_start = tried(fit, early, without, is_astray);
  return cost_of(from_start.fit) < cost_of(trial.fit) ? std::move(from_start) : std::move(trial);
}

double cost_of(const AxisFit& fit) {
  double cost = fit.unlikeliness();
  for (const gap::AppliedEffect& effect : fit.model().effects) cost += freedom_cost(fit, effect);
  return cost;
}

double freedom_cost(const AxisFit& fit, const gap::AppliedEffect& effect) {
  const double onset = effect.onset_s > 0.0 ? 1.0 : 0.0;
  return (effect.form.parts + 1.0 + onset) * std::log(static_cast<double>(fit.signals().rows) + 2.0);
}

bool is_bent(const AxisFit& fit) {
  const Eigen::VectorXd deviation = fit.deviation().cwiseAbs();
  const Eigen::Index relative = fit.axis() == Axis::kSpindle ? deviation.size() : 2;
  for (Eigen::Index j = 0; j < relative; ++j)
    if (deviation(j) > kBent && fit.tells(j)) return true;
  return false;
}

bool acts_the_wrong_way(const gap::AppliedEffect& effect, const AxisFit& fit) {
  if (turns_round(effect, fit)) return true;
  const gap::Effect own = effect.form.effect;
  const bool is_shape = gap::is_stribeck(own) || own == gap::Effect::kSpindleWindage;
  if (!gap::acts_one_way(own) || is_shape || !(effect.coefficient[0] < 0.0)) return false;
  if (gap::info_of(own).range != gap::SizeRange::kAnySign) return true;
  const bool has_bend = effect.form.parts > 1 && gap::bends(own);
  if (has_bend && effect.coefficient[0] + bend_at_most(effect.form, fit) * effect.coefficient[1] > 0.0)
    return false;
  const auto& known = fit.model().known;
  return std::none_of(known.begin(), known.end(),
                      [own](const gap::AppliedEffect& one) { return is_of_one_kind(one.form.effect, own); });
}

AxisFit at_datasheet(const AxisFit& fit) {
  AxisFit anew(fit.axis(), fit.signals(), fit.datasheet());
  anew.allow_noise_like(fit);
  anew.change_model().effects = fit.model().effects;
  return anew;
}

}  // namespace morepro::host
