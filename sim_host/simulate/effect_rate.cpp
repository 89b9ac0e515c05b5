#include "sim_host/simulate/effect_rate.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/simulate/state_effects.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

// Twice the reference point: profiles hardly go beyond it.
constexpr double kBeyond = 2.0;

double side_of(const gap::AppliedEffect& stribeck) {
  return static_cast<double>(gap::laws::stribeck_side(stribeck.form.effect));
}

double rate_in_spindle(const gap::AppliedEffect& one, const gap::EffectScales<double>& k) {
  const double size = std::fabs(one.coefficient[0]);
  const double shape = static_cast<double>(one.form.shape);
  const double smooth = static_cast<double>(gap::laws::kSmoothShare) * k.speed_rad_s;
  switch (one.form.effect) {
    case Effect::kSpindleCoulombFriction:
      if (gap::is_bristle(one.form)) return std::sqrt(size / (shape * k.inertia_kgm2));
      return size / (shape * k.speed_rad_s * k.inertia_kgm2);
    case Effect::kSpindleStribeckFriction:
      return size / (side_of(one) * shape * k.speed_rad_s * k.inertia_kgm2);
    case Effect::kContactSpeedDependence:
    case Effect::kContactChipLoadDependence:
    case Effect::kContactTemperatureDependence:
    case Effect::kToolWearRamp:
      return kBeyond * size / (smooth * k.inertia_kgm2);
    case Effect::kSpindleWindage:
      return 2.0 * kBeyond * size * k.speed_rad_s / k.inertia_kgm2;
    case Effect::kSpindleCogging:
      return std::max(std::sqrt(size * shape / k.inertia_kgm2), kBeyond * shape * k.speed_rad_s);
    case Effect::kToothPassingTorque:
      return std::max(std::sqrt(2.0 * size * k.teeth / k.inertia_kgm2),
                      2.0 * kBeyond * k.teeth * k.speed_rad_s);
    case Effect::kShaftCompliance:
      return 6.3 * shape;
    default:
      return 0.0;
  }
}

double rate_in_feed(const gap::AppliedEffect& one, const gap::EffectScales<double>& k) {
  const double size = std::fabs(one.coefficient[0]);
  const double shape = static_cast<double>(one.form.shape);
  switch (one.form.effect) {
    case Effect::kFeedCoulombFriction:
      return size / (shape * k.feed_speed_m_s * k.mass_kg);
    case Effect::kFeedStribeckFriction:
      return size / (side_of(one) * shape * k.feed_speed_m_s * k.mass_kg);
    case Effect::kFeedViscousFriction:
      return size / k.mass_kg;
    case Effect::kFeedAsymmetricFriction:
      return size / (k.feed_speed_m_s * k.mass_kg);
    case Effect::kFeedSpring:
      return std::sqrt(size / k.mass_kg);
    case Effect::kFeedPresliding:
      return std::sqrt(size / (shape * k.mass_kg));
    default:
      return 0.0;
  }
}

double rate_in_armature(const gap::AppliedEffect& one, const gap::EffectScales<double>& k) {
  const double size = std::fabs(one.coefficient[0]);
  const double shape = static_cast<double>(one.form.shape);
  const double electrical = k.resistance_ohm / k.inductance_h;
  const double peak_a = 10.0 * k.current_a;
  switch (one.form.effect) {
    case Effect::kBrushVoltageDrop:
      return size / (shape * k.current_a * k.inductance_h);
    case Effect::kInductanceSaturation:
      return electrical * (1.0 + size * peak_a * peak_a);
    default:
      return 0.0;
  }
}

}  // namespace

double fastest_rate(std::span<const gap::AppliedEffect> effects, const gap::EffectScales<double>& scales) {
  double sum = 0.0;
  for (const gap::AppliedEffect& one : effects) {
    if (!gap::has_size(one)) continue;
    sum += rate_in_spindle(one, scales) + rate_in_feed(one, scales) + rate_in_armature(one, scales);
  }
  return sum;
}

}  // namespace morepro::host
