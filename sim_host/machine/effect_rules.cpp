#include "sim_host/machine/effect_rules.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/gap/effect_catalogue.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

constexpr double kLargestSize = 1.0e12;
// The simulated sensors remember this much.
constexpr double kLongestDelayS = 0.04;

int highest_kind(Effect effect) {
  switch (effect) {
    case Effect::kSpindleCoulombFriction:
    case Effect::kFeedToothPassingForce:
    case Effect::kViscousTemperatureDependence:
    case Effect::kFeedCuttingSpeedDependence:
    case Effect::kArmatureReaction:
    case Effect::kMagnetTemperatureDrift:
    case Effect::kCurrentNonlinearity:
      return 1;
    case Effect::kToothPassingTorque:
      return 3;
    case Effect::kShaftCompliance:
      return gap::kShaftDampings - 1;
    default:
      return 0;
  }
}

int most_parts(Effect effect) {
  if (gap::may_be_refined(effect)) return 2;
  switch (effect) {
    case Effect::kSpindleCogging:
    case Effect::kToothPassingTorque:
    case Effect::kFeedScrewPeriodic:
    case Effect::kFeedToothPassingForce:
    case Effect::kEncoderEccentricity:
      return static_cast<int>(gap::kMostParts);
    case Effect::kFeedBacklash:
      return 2;
    default:
      return 1;
  }
}

enum class Shape { kNone, kPositive, kNotNegative };

Shape shape_of(Effect effect) {
  if (effect == Effect::kFeedScrewPeriodic || gap::size_is_shape(effect)) return Shape::kNotNegative;
  return gap::needs_shape(effect) ? Shape::kPositive : Shape::kNone;
}

std::string objection_to_shape(Effect effect, double shape) {
  const Shape kind = shape_of(effect);
  if (kind == Shape::kNone && shape != 0.0) return "has no shape; remove it";
  if (kind == Shape::kPositive && !(shape > 0.0))
    return fmt::format("cannot have the shape {:g}; it must be greater than 0", shape);
  if (!(shape >= 0.0 && shape <= kLargestSize))
    return fmt::format("cannot have the shape {:g}; it must not be negative", shape);
  return {};
}

}  // namespace

std::string objection_to_size(Effect effect, double size) {
  const gap::EffectInfo& info = gap::info_of(effect);
  if (!(std::fabs(size) <= kLargestSize)) return fmt::format("{} {} is no possible size", size, info.unit);
  if (info.range != gap::SizeRange::kAnySign && size < 0.0)
    return fmt::format("{} {} is impossible; it must not be negative", size, info.unit);
  if (info.range == gap::SizeRange::kFraction && size >= 1.0)
    return fmt::format("{} is impossible; it is a fraction below 1", size);
  if (gap::is_delay(effect) && size > kLongestDelayS)
    return fmt::format("{} s is too long; delays up to {} s are simulated", size, kLongestDelayS);
  return {};
}

std::string objection_to_form(const gap::EffectForm& form) {
  if (form.kind > highest_kind(form.effect))
    return fmt::format("has no kind {}; the highest is {}", form.kind, highest_kind(form.effect));
  if (form.parts < 1 || form.parts > most_parts(form.effect))
    return fmt::format("has {} coefficients; it can have 1 to {}", form.parts, most_parts(form.effect));
  return objection_to_shape(form.effect, static_cast<double>(form.shape));
}

}  // namespace morepro::host
