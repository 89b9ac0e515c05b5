#pragma once
#include <array>
#include <cstddef>
#include <utility>

#include "sim_host/diagnose/fit/axis_fit.hpp"

namespace morepro::host {

inline constexpr double kSharper = 2.0;  // deviance that another shape has to gain
inline constexpr int kRounds = 2;

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
