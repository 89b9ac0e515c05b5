#include "sim_host/diagnose/fit/interval_parts.hpp"

#include <algorithm>
#include <cmath>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/effect_form.hpp"

namespace morepro::host {
namespace {

/// Is there one among the effects of the axis's model, or the terms, that `is_such`? A machine file's are of
/// both axes.
template <class Such>
bool any(Axis axis, const GapModel& model, std::span<const gap::EffectForm> terms, Such is_such) {
  const auto is_one = [&](const gap::EffectForm& form) {
    return gap::is_of_feed(form.effect) == (axis == Axis::kFeed) && is_such(form);
  };
  const auto is_applied = [&](const gap::AppliedEffect& one) { return is_one(one.form); };
  return std::any_of(model.known.begin(), model.known.end(), is_applied) ||
         std::any_of(model.effects.begin(), model.effects.end(), is_applied) ||
         std::any_of(terms.begin(), terms.end(), is_one);
}

/// Does it depend on the speed of the spindle and on what changes as slowly? Then it is the same throughout
/// an interval, unless the spindle turns. A current is another one after half a millisecond, an angle after
/// some degrees, and what remembers steps needs all of them to be of one length. A sensor without a memory
/// shows its error at a sample, whatever was in between.
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
      return true;
    default:
      return gap::is_in_sensor(form.effect) && !gap::size_is_shape(form.effect);
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
  constexpr double kSlow = 0.1;           // of the reference speed: by no more does one change
  constexpr double kMeanwhileS = 1.0e-3;  // within so long
  const double interval_s = 1.0 / signals.rate_hz;
  const bool has_bristle = !signals.is_thinned && any(axis, model, {}, gap::is_bristle);
  if (axis == Axis::kFeed) {
    if (has_bristle) most_ = parts_of(interval_s, 2.5e-4);
    return;
  }
  if (!has_bristle && !signals.has_been_in_contact()) return;
  most_ = parts_of(interval_s, 1.25e-4);
  is_same_always_ =
      any(axis, model, terms, [](const gap::EffectForm& form) { return !changes_slowly(form); });
  slow_rad_s_ = kSlow * std::max(1.0, interval_s / kMeanwhileS) * model.point.speed_rad_s;
}

}  // namespace morepro::host
