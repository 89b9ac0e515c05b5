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
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr float kNarrowest = 0.02F;  // share of the shape that a linearisation shows
constexpr double kSharper = 2.0;     // deviance that another shape has to gain
constexpr int kRounds = 2;
// Before an onset that is known to half a block nothing depends on it; behind it an effect may need long to
// show.
constexpr double kBeforeOnsetS = 1.0;

/// Takes the variants of a trial that are likelier, with everything refitted: `vary(effect, value)` makes
/// one of the newest effect, or gives false where there is none. Was there any? A size that a valley leads
/// along without an end is not followed for ever: twelve thousand variants of a friction took 150 s.
template <class Value, std::size_t kCount, class Vary>
bool take_likelier(AxisFit& trial, const std::array<Value, kCount>& values, Vary vary) {
  constexpr int kMostTimes = 25;
  bool has_changed = false;
  for (const Value value : values) {
    for (int times = 0; times < kMostTimes; ++times) {
      AxisFit other = trial;
      if (!vary(other.change_model().effects.back(), value)) break;
      other.refit(trial.promised_in_vain());
      if (!(other.unlikeliness() < trial.unlikeliness() - kSharper)) break;
      trial = std::move(other);
      has_changed = true;
    }
  }
  return has_changed;
}

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

/// Noise and the rest in turns, unless that leads away: a round of noise may make a fitted model less likely
/// by a thousand, where a machine is not quite like it.
void settle_fitted(AxisFit& fit) {
  const AxisFit fitted = fit;
  fit.settle(kRounds);
  if (!(fit.unlikeliness() < fitted.unlikeliness())) fit = fitted;
}

/// Is there so much noise that nothing that hides in it is worth a search beside little? Deviance that it
/// takes per row: where such a search led anywhere up to 0.53, on a measured axis, where it never did, 8.6.
bool is_real_noise(const AxisFit& quiet, const AxisFit& loud) {
  constexpr double kMost = 2.0;
  const double rows = static_cast<double>(quiet.signals().rows) / (quiet.is_narrow() ? 4.0 : 1.0);
  return quiet.unlikeliness() - loud.unlikeliness() > kMost * rows;
}

/// How sure a state is depends on the friction that holds it; no linearisation knows that, so that sizes are
/// tried too. Where a fit comes back from far more and from far less it does so from what lies between.
bool search_size(AxisFit& trial) {
  constexpr double kSame = 10.0;  // deviance, between fits that ended in one place
  const auto resize = [](gap::AppliedEffect& effect, float factor) {
    for (double& part : effect.coefficient) part *= static_cast<double>(factor);
    return true;
  };
  const auto comes_back_from = [&](float factor) {
    AxisFit other = trial;
    resize(other.change_model().effects.back(), factor);
    other.refit(trial.promised_in_vain());
    return std::fabs(other.unlikeliness() - trial.unlikeliness()) < kSame;
  };
  if (comes_back_from(2.5F) && comes_back_from(0.6F)) return false;
  return take_likelier(trial, std::array{2.5F, 1.6F, 0.6F, 1.2F, 0.9F}, resize);
}

/// Takes the shape of the newest effect at which a parabola through what three of them are worth has its
/// vertex: its own, and one on each side, as far as `spread`, a share of it. Is it another one?
bool take_vertex(AxisFit& trial, double spread) {
  const auto at = [&trial](double share) {
    AxisFit other = trial;
    other.change_model().effects.back().form.shape *= static_cast<float>(1.0 + share);
    other.refit(trial.promised_in_vain());
    return other;
  };
  const double own = trial.unlikeliness();
  const double narrower = at(-spread).unlikeliness(), wider = at(spread).unlikeliness();
  const double bend = narrower + wider - 2.0 * own;
  if (!(bend > 0.0) || !std::isfinite(bend)) return false;
  AxisFit other = at(std::clamp(0.5 * (narrower - wider) / bend, -1.0, 1.0) * spread);
  if (!(other.unlikeliness() < own - kSharper)) return false;
  trial = std::move(other);
  return true;
}

/// Searches for the width of a fitted friction, up to a share of what was seen, and for its size. Was there a
/// likelier one?
bool search_friction(AxisFit& trial, float seen, float widest_share) {
  const auto reshape = [seen, widest_share](gap::AppliedEffect& effect, float factor) {
    effect.form.shape *= factor;
    return effect.form.shape >= kNarrowest * seen && effect.form.shape <= widest_share * seen;
  };
  bool has_shape =
      take_likelier(trial, std::array{0.2F, 0.4F, 1.7F, 0.7F, 0.85F, 1.15F, 0.95F, 1.05F}, reshape);
  for (const double spread : {0.03, 0.01}) has_shape |= take_vertex(trial, spread);
  return search_size(trial) || has_shape;
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

/// The least and the most that a bristle may yield, in rad or m.
struct Yields {
  float least;
  float most;

  bool reshape(gap::AppliedEffect& bristle, float factor) const {
    bristle.form.shape *= factor;
    return bristle.form.shape >= least && bristle.form.shape <= most;
  }
};

/// Takes a bristle that yields as far as it is most likely, beside little noise, where that is likelier.
void take_yield(AxisFit bristle, Yields yields, AxisFit& trial) {
  bristle.narrow_down();
  bristle.expect_little_noise();
  bristle.refit();
  const auto reshape = [yields](gap::AppliedEffect& effect, float factor) {
    return yields.reshape(effect, factor);
  };
  AxisFit best = bristle;
  for (const float factor : {0.0625F, 0.25F, 4.0F, 16.0F}) {
    AxisFit other = bristle;
    if (!reshape(other.change_model().effects.back(), factor)) continue;
    other.refit();
    if (other.unlikeliness() < best.unlikeliness()) best = std::move(other);
  }
  bristle = std::move(best);
  take_likelier(bristle, std::array{0.5F, 2.0F, 0.7F, 1.4F, 0.9F, 1.1F, 0.97F, 1.03F}, reshape);
  bristle.settle_roughly(kRounds, {});
  bristle.widen();
  bristle.polish();
  if (bristle.unlikeliness() < trial.unlikeliness() - kSharper) trial = std::move(bristle);
}

/// Takes the bend out of its law.
void straighten_newest(AxisFit& trial) {
  gap::AppliedEffect& newest = trial.change_model().effects.back();
  newest.form.parts = 1;
  newest.coefficient[1] = 0.0;
  trial.polish();
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

// Process noise that was fitted to too little friction hides friction, and the other way round: one search
// begins with what there is, the other with little noise.
void sharpen_newest(AxisFit& trial, float widest_share) {
  const float seen = trial.model().effects.back().form.shape;
  AxisFit sharper = trial;
  sharper.narrow_down();
  AxisFit quiet = sharper;
  quiet.expect_little_noise();
  in_parallel(2, [&](std::size_t i) { (i == 0 ? sharper : quiet).refit(); });
  const bool is_loud = is_real_noise(quiet, sharper);
  bool has_changed = false;
  in_parallel(is_loud ? 1 : 2, [&](std::size_t i) {
    AxisFit& fit = i == 0 ? sharper : quiet;
    const bool is_other = search_friction(fit, seen, widest_share);
    settle_fitted(fit);
    if (i == 0) has_changed = is_other;
  });
  if (quiet.unlikeliness() < sharper.unlikeliness() - kSharper) {
    sharper = std::move(quiet);
    has_changed = true;
  }
  if (!has_changed) return;
  sharper.widen();
  sharper.polish();
  if (sharper.unlikeliness() < trial.unlikeliness()) trial = std::move(sharper);
}

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

// From the plain law, too: a bend does the work of a wrong range.
void sharpen_range_of_newest(AxisFit& trial) {
  constexpr float kAnyRange = 3.0F;  // share of the shape that a linearisation shows
  const bool is_bent = trial.model().effects.back().form.parts > 1;
  AxisFit plain = trial;
  in_parallel(is_bent ? 2 : 1, [&](std::size_t i) {
    if (i == 1) straighten_newest(plain);
    sharpen_newest(i == 0 ? trial : plain, kAnyRange);
    if (i == 1) weigh_bend(plain, plain.model().effects.size() - 1);
  });
  if (!is_bent) return;
  const double price = std::log(static_cast<double>(plain.signals().rows) + 2.0);
  const double saved = plain.model().effects.back().form.parts == 1 ? price : 0.0;
  if (plain.unlikeliness() < trial.unlikeliness() + saved) trial = std::move(plain);
}

// What is fitted to another way to yield, or to the wrong distance, hides this one: it begins with little
// noise.
void weigh_bristle(AxisFit& trial) {
  constexpr float kUsualYieldRad = 0.05F;
  constexpr Yields kAny{1.0e-4F, 3.0F};
  AxisFit bristle = trial;
  gap::EffectForm& form = bristle.change_model().effects.back().form;
  form.kind = 1;
  form.shape = kUsualYieldRad;
  take_yield(std::move(bristle), kAny, trial);
}

// Little noise leads astray where the parameters are still bent to the wrong yield: a second search begins
// where the noise as it is leads first.
void tune_bristle(AxisFit& trial) {
  static constexpr Yields kAny{1.0e-8F, 1.0e-2F};
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
