#include "sim_host/diagnose/search/earlier_friction.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "lib/gap/dry_friction.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/search/newest_effect.hpp"

namespace morepro::host {
namespace {

// Of the reference speed: a friction that changes its side more slowly is another law.
constexpr float kWidest = 0.1F;

using Effects = std::vector<gap::AppliedEffect>;

void make_newest(std::size_t index, Effects& effects) {
  const auto it = effects.begin() + static_cast<std::ptrdiff_t>(index);
  std::rotate(it, it + 1, effects.end());
}
void put_back(std::size_t index, Effects& effects) {
  std::rotate(effects.begin() + static_cast<std::ptrdiff_t>(index), effects.end() - 1, effects.end());
}

/// The newest effect with the width that is likeliest beside the usual noise: what the wrong one left passes
/// for random forces, beside which all widths are much alike.
AxisFit with_likeliest_width(AxisFit start) {
  start.narrow_down();
  start.expect_noise(kUsualNoiseShare);
  AxisFit best = start;
  best.refit();
  for (const float factor : {0.25F, 0.5F, 2.0F, 4.0F, 8.0F, 16.0F}) {
    AxisFit other = start;
    float& width = other.change_model().effects.back().form.shape;
    width *= factor;
    if (width > kWidest) break;
    other.refit();
    if (other.unlikeliness() < best.unlikeliness()) best = std::move(other);
  }
  best.widen();
  best.polish();
  return best;
}

}  // namespace

void sharpen_earlier_frictions(AxisFit& fit) {
  for (std::size_t i = 0; i + 1 < fit.model().effects.size(); ++i) {
    const gap::EffectForm& form = fit.model().effects[i].form;
    if (!gap::is_dry_friction(form) || gap::is_stribeck(form.effect)) continue;
    AxisFit other = fit;
    make_newest(i, other.change_model().effects);
    other = with_likeliest_width(std::move(other));
    sharpen_newest(other, kWidest / other.model().effects.back().form.shape);
    put_back(i, other.change_model().effects);
    other.refit();
    if (other.unlikeliness() < fit.unlikeliness()) fit = std::move(other);
  }
}

}  // namespace morepro::host
