#include "sim_host/diagnose/search/newest_effect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "sim_host/diagnose/search/candidate_forms.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/likelier_variant.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

// Before an onset that is known to half a block nothing depends on it; behind it an effect may need long to
// show.
constexpr double kBeforeOnsetS = 1.0;

/// Exchanges the time constant of a drive's lag with the axis's own, where that leaves parameters that a
/// datasheet may have. Does it?
bool exchange_lags(GapModel& model) {
  constexpr double kMostApart = 2.5;
  gap::EffectForm& lag = model.effects.back().form;
  auto& spindle = model.machine.spindle;
  auto& feed = model.machine.feed;
  const auto lag_s = static_cast<double>(lag.shape);
  double own_s = 0.0;
  if (lag.effect == gap::Effect::kDriveLag) own_s = spindle.inductance_h / spindle.resistance_ohm;
  if (lag.effect == gap::Effect::kFeedDriveLag) own_s = feed.mass_kg / feed.viscous_friction_ns_m;
  if (!(own_s > lag_s / kMostApart && own_s < lag_s * kMostApart)) return false;
  lag.shape = static_cast<float>(own_s);
  if (lag.effect == gap::Effect::kDriveLag)
    spindle.inductance_h = lag_s * spindle.resistance_ohm;
  else
    feed.mass_kg = lag_s * feed.viscous_friction_ns_m;
  return true;
}

/// Searches for a shaft's damping and for its resonance, in `factors` of what it has, in turns.
template <std::size_t kCount>
void search_shaft(AxisFit& trial, const std::array<float, kCount>& factors) {
  const auto damp = [](gap::AppliedEffect& shaft, std::uint8_t kind) {
    return std::exchange(shaft.form.kind, kind) != kind;
  };
  const auto detune = [](gap::AppliedEffect& shaft, float factor) {
    shaft.form.shape *= factor;
    return true;
  };
  constexpr int kMostTurns = 3;
  std::array<std::uint8_t, gap::kShaftDampings> dampings{};
  std::iota(dampings.begin(), dampings.end(), std::uint8_t{0});
  trial.refit();
  bool has_changed = true;
  for (int turn = 0; turn < kMostTurns && has_changed; ++turn) {
    has_changed = take_likelier(trial, dampings, damp);
    has_changed |= take_likelier(trial, factors, detune);
  }
}

/// Beside little noise and on all that was recorded: a resonance half a percent beside the right one, or
/// noise that was fitted to another one, has bent the scale of torque by 0.8 %.
void sharpen_shaft(AxisFit& trial) {
  AxisFit quiet = trial;
  quiet.expect_little_noise();
  search_shaft(quiet, std::array{0.995F, 1.005F, 0.9985F, 1.0015F, 0.9995F, 1.0005F});
  quiet.polish();
  if (quiet.unlikeliness() < trial.unlikeliness()) trial = std::move(quiet);
}

/// Takes a bristle that yields as far as it is most likely, beside little noise, where that is likelier.
void take_yield(AxisFit bristle, ShapeBounds yields, AxisFit& trial) {
  bristle.narrow_down();
  bristle.expect_little_noise();
  bristle.refit();
  const auto reshape = [yields](gap::AppliedEffect& effect, float factor) {
    return yields.reshape(effect, factor);
  };
  const AxisFit start = bristle;
  take_likeliest_shape(start, yields, std::array{0.0625F, 0.25F, 4.0F, 16.0F}, bristle);
  take_likelier(bristle, std::array{0.5F, 2.0F, 0.7F, 1.4F, 0.9F, 1.1F, 0.97F, 1.03F}, reshape);
  bristle.settle_roughly(kRounds, {});
  bristle.widen();
  bristle.polish();
  if (bristle.unlikeliness() < trial.unlikeliness() - kSharper) trial = std::move(bristle);
}

// Of friction that grows with another power of the speed than the first: its slope as a share of the speed,
// at the fastest over at rest. What is bent further is another law: a bump in the way had 0.31, powers of 1.1
// and 1.25 1.1 .. 2.5.
constexpr double kLeastSlope = 0.45;
constexpr double kMostSlope = 4.0;

/// Is friction that depends on the direction bent beside a dry one, whose own shape is worth as much? On the
/// ball-screw axis of the measured recordings it took half a newton from the constant force.
bool is_hidden_bend(const GapModel& model, std::size_t index) {
  const gap::EffectForm& form = model.effects[index].form;
  return form.effect == gap::Effect::kFeedAsymmetricFriction && form.parts > 1 &&
         std::any_of(model.effects.begin(), model.effects.end(), [](const gap::AppliedEffect& other) {
           return family_of(other.form.effect) == Family::kDryFriction;
         });
}

}  // namespace

bool bends_too_far(const gap::AppliedEffect& effect, double fastest_m_s, double reference_m_s) {
  if (effect.form.effect != gap::Effect::kFeedAsymmetricFriction || effect.form.parts < 2) return false;
  const double plain = effect.coefficient[0];
  const double bent = effect.coefficient[1];
  const double change = (plain + bent * (fastest_m_s / reference_m_s - 1.0)) / (plain - bent);
  return !(change > kLeastSlope && change < kMostSlope);
}

void weigh_bend(AxisFit& trial, std::size_t index) {
  const gap::Effect effect = trial.model().effects[index].form.effect;
  if (!tells_second_part(effect, trial.signals())) return;
  const double fastest_m_s = trial.signals().largest(Channel::kFeedSpeed);
  const auto is_too_far = [&](const AxisFit& fit) {
    return bends_too_far(fit.model().effects[index], fastest_m_s, fit.model().point.feed_speed_m_s) ||
           is_hidden_bend(fit.model(), index);
  };
  AxisFit other = trial;
  gap::EffectForm& form = other.change_model().effects[index].form;
  const double price = std::log(static_cast<double>(trial.signals().rows) + 2.0);
  const bool is_bent = form.parts > 1;
  const auto gain = [&] { return trial.unlikeliness() - other.unlikeliness(); };
  form.parts = is_bent ? 1 : 2;
  other.change_model().effects[index].coefficient[1] = 0.0;
  other.refit();
  // With its own noise a bend gains more, but not twice as much.
  if (!is_bent && gain() < 0.5 * price) return;
  other.polish();
  if (is_too_far(trial) || (gain() > (is_bent ? -price : price) && !is_too_far(other)))
    trial = std::move(other);
}

// What is fitted to another way to yield, or to the wrong distance, hides this one: it begins with little
// noise.
void weigh_bristle(AxisFit& trial) {
  constexpr float kUsualYieldRad = 0.05F;
  constexpr ShapeBounds kAny{1.0e-4F, 3.0F};
  AxisFit bristle = trial;
  gap::EffectForm& form = bristle.change_model().effects.back().form;
  form.kind = 1;
  form.shape = kUsualYieldRad;
  take_yield(std::move(bristle), kAny, trial);
}

// Little noise leads astray where the parameters are still bent to the wrong yield: a second search begins
// where the noise as it is leads first.
void tune_bristle(AxisFit& trial) {
  static constexpr ShapeBounds kAny{1.0e-8F, 1.0e-2F};
  const auto reshape = [](gap::AppliedEffect& effect, float factor) { return kAny.reshape(effect, factor); };
  AxisFit loud = trial;
  bool has_changed = false;
  in_parallel(2, [&](std::size_t i) {
    if (i == 0) return take_yield(trial, kAny, trial);
    loud.narrow_down();
    loud.refit();
    has_changed = take_likelier(loud, std::array{0.7F, 1.4F, 0.9F, 1.1F}, reshape);
    if (!has_changed) return;
    loud.widen();
    loud.polish();
    take_yield(loud, kAny, loud);
  });
  if (has_changed && loud.unlikeliness() < trial.unlikeliness()) trial = std::move(loud);
}

// The play was taken for process noise, which hides it now: another search begins with little.
void tune_play(AxisFit& trial) {
  const auto widen = [](gap::AppliedEffect& play, float factor) {
    play.form.shape *= factor;
    return true;
  };
  AxisFit quiet = trial;
  quiet.expect_little_noise();
  quiet.refit();
  for (AxisFit* fit : {&trial, &quiet})
    take_likelier(*fit, std::array{0.93F, 1.07F, 0.98F, 1.02F, 0.995F, 1.005F}, widen);
  quiet.polish();
  if (quiet.unlikeliness() < trial.unlikeliness()) trial = std::move(quiet);
}

// At which end the cut is and how the shaft is damped hide each other: the search begins with either end.
// What a wrong damping leaves passes for process noise, which then hides it: a second one begins with little.
void tune_newest(AxisFit& trial, double rival) {
  AxisFit tuned = trial;
  tuned.narrow_down();
  gap::EffectForm& form = tuned.change_model().effects.back().form;
  if (tells_second_part(form.effect, trial.signals())) form.parts = 2;
  AxisFit quiet = tuned;
  quiet.expect_little_noise();
  for (AxisFit* fit : {&tuned, &quiet}) {
    search_shaft(*fit, std::array{0.9F, 1.1F, 0.95F, 1.05F, 0.98F, 1.02F, 0.995F, 1.005F});
    settle_fitted(*fit);
    fit->widen();
    fit->polish();
    if (fit->unlikeliness() < trial.unlikeliness()) trial = std::move(*fit);
  }
  if (trial.unlikeliness() < rival) sharpen_shaft(trial);
}

void weigh_order_of_lags(AxisFit& trial) {
  AxisFit other = trial;
  if (!exchange_lags(other.change_model())) return;
  other.settle(kRounds);
  if (other.unlikeliness() < trial.unlikeliness() - kSharper) trial = std::move(other);
}

void place_onset_of_newest(AxisFit& trial) {
  AxisFit late = trial;
  double& onset_s = late.change_model().effects.back().onset_s;
  late.look_at_the_end(onset_s - std::max(kBeforeOnsetS, trial.block_s()));
  double best = late.unlikeliness_as_it_is();
  for (double step_s = 0.5 * trial.block_s(); step_s > 0.01 * trial.block_s(); step_s *= 0.5)
    for (const double sign : {-1.0, 1.0}) {
      const double before_s = onset_s;
      onset_s = std::max(before_s + sign * step_s, 0.0);
      const double other = late.unlikeliness_as_it_is();
      if (other < best)
        best = other;
      else
        onset_s = before_s;
    }
  trial.change_model().effects.back().onset_s = onset_s;
  trial.refit();
}

}  // namespace morepro::host
