#pragma once
#include <array>
#include <cstddef>
#include <utility>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

inline constexpr double kSharper = 2.0;  // deviance that another shape has to gain
inline constexpr int kRounds = 2;

/// Between which the shape of an effect may be, in its unit.
struct ShapeBounds {
  float least;
  float most;

  /// Is it between them still?
  bool reshape(gap::AppliedEffect& effect, float factor) const {
    effect.form.shape *= factor;
    return effect.form.shape >= least && effect.form.shape <= most;
  }
};

/// Takes for `best` what is likelier with another shape of the newest effect, each in `factors` of the one
/// that `start` has, fitted from there: where valleys are far apart no step leads from one to the other.
template <std::size_t kCount>
void take_likeliest_shape(const AxisFit& start, ShapeBounds bounds, const std::array<float, kCount>& factors,
                          AxisFit& best) {
  for (const float factor : factors) {
    AxisFit other = start;
    if (!bounds.reshape(other.change_model().effects.back(), factor)) continue;
    other.refit();
    if (other.unlikeliness() < best.unlikeliness()) best = std::move(other);
  }
}

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

/// Noise and the rest in turns, unless that leads away: a round of noise may make a fitted model less likely
/// by a thousand, where a machine is not quite like it.
inline void settle_fitted(AxisFit& fit) {
  const AxisFit fitted = fit;
  fit.settle(kRounds);
  if (!(fit.unlikeliness() < fitted.unlikeliness())) fit = fitted;
}

}  // namespace morepro::host
