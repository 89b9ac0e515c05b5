#include "sim_host/diagnose/search/friction_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "lib/gap/dry_friction.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/search/likelier_variant.hpp"
#include "sim_host/diagnose/search/newest_effect.hpp"
#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr float kNarrowest = 0.02F;  // share of the shape that a linearisation shows
// Of the reference speed: a friction that changes its side more slowly is another law.
constexpr float kWidest = 0.1F;

/// Gives the newest effect the width that is likeliest beside little noise. What a wrong one leaves passes
/// for random forces, beside which all widths are much alike, and beside no noise at all what is far too
/// narrow is likelier than what is nearly right: beside the usual noise the right one is the only valley.
///
/// A spindle is hardly ever between the sides, and of a motor without a current sensor (`chirp_1` of the
/// measured ones) all widths led away from its friction: there little noise alone is expected.
void take_likeliest_width(ShapeBounds widths, AxisFit& fit) {
  if (fit.axis() == Axis::kSpindle) {
    fit.expect_little_noise();
    return fit.refit();
  }
  fit.expect_noise(kUsualNoiseShare);
  constexpr std::array kOctaves{0.03125F, 0.0625F, 0.125F, 0.25F, 0.5F, 2.0F, 4.0F, 8.0F, 16.0F};
  const AxisFit start = fit;
  fit.refit();
  take_likeliest_shape(start, widths, kOctaves, fit);
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
    other.refit();
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

/// Searches for the width of a fitted friction, and for its size. Was there a likelier one?
bool search_friction(AxisFit& trial, ShapeBounds widths) {
  const auto reshape = [widths](gap::AppliedEffect& effect, float factor) {
    return widths.reshape(effect, factor);
  };
  const bool has_shape =
      take_likelier(trial, std::array{0.2F, 0.4F, 1.7F, 0.7F, 0.85F, 1.15F, 0.95F, 1.05F}, reshape);
  return search_size(trial) || has_shape;
}

/// Takes the bend out of its law.
void straighten_newest(AxisFit& trial) {
  gap::AppliedEffect& newest = trial.change_model().effects.back();
  newest.form.parts = 1;
  newest.coefficient[1] = 0.0;
  trial.polish();
}

void make_newest(std::size_t index, std::vector<gap::AppliedEffect>& effects) {
  const auto it = effects.begin() + static_cast<std::ptrdiff_t>(index);
  std::rotate(it, it + 1, effects.end());
}
void put_back(std::size_t index, std::vector<gap::AppliedEffect>& effects) {
  std::rotate(effects.begin() + static_cast<std::ptrdiff_t>(index), effects.end() - 1, effects.end());
}

}  // namespace

// Process noise that was fitted to too little friction hides friction, and the other way round: one search
// begins with what there is, the other with the width that is likeliest beside little noise.
void sharpen_newest(AxisFit& trial, float widest_share) {
  const float seen = trial.model().effects.back().form.shape;
  const ShapeBounds widths{kNarrowest * seen, widest_share * seen};
  AxisFit sharper = trial;
  sharper.narrow_down();
  AxisFit quiet = sharper;
  in_parallel(2, [&](std::size_t i) { i == 0 ? sharper.refit() : take_likeliest_width(widths, quiet); });
  const bool is_loud = is_real_noise(quiet, sharper);
  bool has_changed = false;
  in_parallel(is_loud ? 1 : 2, [&](std::size_t i) {
    AxisFit& fit = i == 0 ? sharper : quiet;
    bool is_other = search_friction(fit, widths);
    settle_fitted(fit);
    // The likeliest width depends on the noise.
    for (const double spread : {0.03, 0.01, 0.003}) is_other |= take_vertex(fit, spread);
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

void sharpen_earlier_frictions(AxisFit& fit) {
  for (std::size_t i = 0; i + 1 < fit.model().effects.size(); ++i) {
    const gap::EffectForm& form = fit.model().effects[i].form;
    if (!gap::is_dry_friction(form) || gap::is_stribeck(form.effect)) continue;
    AxisFit other = fit;
    make_newest(i, other.change_model().effects);
    sharpen_newest(other, std::max(kWidest / form.shape, 1.0F));
    put_back(i, other.change_model().effects);
    other.refit();
    if (other.unlikeliness() < fit.unlikeliness()) fit = std::move(other);
  }
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

}  // namespace morepro::host
