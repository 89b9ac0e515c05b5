#include "sim_host/diagnose/fit/interval_parts.hpp"

#include <algorithm>
#include <cmath>

#include "lib/gap/effect_form.hpp"

namespace morepro::host {
namespace {

/// Is there one among the effects of the model, or the terms, that `is_such`?
template <class Such>
bool any(const GapModel& model, std::span<const gap::EffectForm> terms, Such is_such) {
  const auto is_applied = [is_such](const gap::AppliedEffect& one) { return is_such(one.form); };
  return std::any_of(model.known.begin(), model.known.end(), is_applied) ||
         std::any_of(model.effects.begin(), model.effects.end(), is_applied) ||
         std::any_of(terms.begin(), terms.end(), is_such);
}

/// Does it depend on the speed of the spindle and on what changes as slowly? Then it is the same throughout
/// an interval, unless the spindle turns. A current is another one after half a millisecond, an angle after
/// some degrees, and what remembers steps needs all of them to be of one length.
bool changes_slowly(const gap::EffectForm& form) {
  switch (form.effect) {
    case gap::Effect::kSpindleCoulombFriction:
      return !gap::is_bristle(form);
    case gap::Effect::kSpindleStribeckFriction:
    case gap::Effect::kSpindleWindage:
    case gap::Effect::kContactSpeedDependence:
    case gap::Effect::kContactChipLoadDependence:
    case gap::Effect::kContactTemperatureDependence:
    case gap::Effect::kToolWearRamp:
    case gap::Effect::kViscousTemperatureDependence:
    case gap::Effect::kSupplyVoltageOffset:
    case gap::Effect::kSpindleSpeedBias:
    case gap::Effect::kCurrentBias:
      return true;
    default:
      return false;
  }
}

std::size_t parts_of(double interval_s, double part_s) {
  constexpr double kLongestS = 1.0e-3;  // that is followed to its end
  // A rate that is a hair too low needs no more parts.
  return static_cast<std::size_t>(std::ceil(std::min(0.999 * interval_s, kLongestS) / part_s));
}

}  // namespace

IntervalParts::IntervalParts(Axis axis, const RecordingSignals& signals, const GapModel& model,
                             std::span<const gap::EffectForm> terms) {
  constexpr double kSlow = 0.1;  // of the reference speed
  const double interval_s = 1.0 / signals.rate_hz;
  const bool has_bristle = !signals.is_thinned && any(model, {}, gap::is_bristle);
  if (axis == Axis::kFeed) {
    if (has_bristle) most_ = parts_of(interval_s, 2.5e-4);
    return;
  }
  if (!has_bristle && !signals.has_been_in_contact()) return;
  const auto changes_fast = [](const gap::EffectForm& form) { return !changes_slowly(form); };
  const bool is_fast = any(model, {}, changes_fast);
  is_same_always_ = is_fast || any(model, terms, changes_fast);
  // What is only asked how much it would explain need not be followed as closely.
  most_ = parts_of(interval_s, is_same_always_ && !is_fast ? 2.5e-4 : 1.25e-4);
  slow_rad_s_ = kSlow * model.point.speed_rad_s;
}

}  // namespace morepro::host
