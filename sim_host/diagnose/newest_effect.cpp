#include "sim_host/diagnose/newest_effect.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace morepro::host {
namespace {

constexpr float kNarrowest = 0.02F;  // share of the width that a linearisation shows
constexpr double kSharper = 2.0;     // deviance that another shape has to gain

}  // namespace

void sharpen_newest(AxisFit& trial) {
  const float widest = trial.model().effects.back().form.shape;
  bool has_changed = false;
  AxisFit found = trial;
  trial.narrow_down();
  trial.refit();
  for (const float factor : {0.2F, 0.4F, 1.7F, 0.7F, 0.85F, 1.15F, 0.95F, 1.05F}) {
    for (;;) {
      AxisFit other = trial;
      float& shape = other.model().effects.back().form.shape;
      shape *= factor;
      if (shape < kNarrowest * widest || shape > widest) break;
      other.refit();
      if (!(other.unlikeliness() < trial.unlikeliness() - kSharper)) break;
      trial = std::move(other);
      has_changed = true;
    }
  }
  trial.widen();
  if (has_changed)
    trial.polish();
  else
    trial = std::move(found);
}

void weigh_bend(AxisFit& trial, std::size_t index) {
  if (!gap::bends(trial.model().effects[index].form.effect)) return;
  AxisFit other = trial;
  gap::EffectForm& form = other.model().effects[index].form;
  const double price = std::log(static_cast<double>(trial.signals().rows) + 2.0);
  const bool is_bent = form.parts > 1;
  form.parts = is_bent ? 1 : 2;
  other.model().effects[index].coefficient[1] = 0.0;
  other.polish();
  const double gain = trial.unlikeliness() - other.unlikeliness();
  if (gain > (is_bent ? -price : price)) trial = std::move(other);
}

void place_onset_of_newest(AxisFit& trial) {
  double& onset_s = trial.model().effects.back().onset_s;
  double best = trial.unlikeliness_as_it_is();
  for (double step_s = 0.5 * kBlockS; step_s > 0.01 * kBlockS; step_s *= 0.5)
    for (const double sign : {-1.0, 1.0}) {
      const double before_s = onset_s;
      onset_s = std::max(before_s + sign * step_s, 0.0);
      const double other = trial.unlikeliness_as_it_is();
      if (other < best)
        best = other;
      else
        onset_s = before_s;
    }
  trial.polish();
}

}  // namespace morepro::host
