#pragma once
#include <cstddef>

#include "lib/gap/applied_effect.hpp"
#include "lib/math/elementary.hpp"

/// Between the one number that an engineer states for an effect and the terms that enter a model.
namespace morepro::gap {
namespace detail {

inline constexpr double kTurnRad = 6.283185307179586;
/// The commonest pitch of small ball screws.
inline constexpr double kUsualPitchM = 5.0e-3;

/// The form of an effect where nothing but its size is known. Its width of friction is narrow against the
/// reference point, its screw has the machine's pitch, its motor eight poles and slots.
constexpr EffectForm usual_form(Effect effect, const EffectScales<double>& scales) {
  switch (effect) {
    case Effect::kSpindleCoulombFriction:
      return {.effect = effect, .shape = 0.002F};
    case Effect::kSpindleStribeckFriction:
      return {.effect = effect, .shape = 0.1F};
    case Effect::kSpindleCogging:
      return {.effect = effect, .parts = 2, .shape = 8.0F};
    case Effect::kToothPassingTorque:
    case Effect::kFeedToothPassingForce:
      return {.effect = effect, .parts = 4};
    case Effect::kFeedCoulombFriction:
      return {.effect = effect, .shape = 0.01F};
    case Effect::kFeedStribeckFriction:
      return {.effect = effect, .shape = 0.3F};
    case Effect::kFeedScrewPeriodic:
      return {.effect = effect,
              .parts = 2,
              .shape = scales.per_screw_turn_rad_m > 0.0 ? 0.0F : static_cast<float>(kUsualPitchM)};
    case Effect::kFeedPresliding:
      return {.effect = effect, .shape = 5.0e-5F};
    case Effect::kBrushVoltageDrop:
      return {.effect = effect, .shape = 0.02F};
    case Effect::kArmatureReaction:
    case Effect::kMagnetTemperatureDrift:
      return {.effect = effect, .kind = 1};
    case Effect::kEncoderEccentricity:
      return {.effect = effect, .parts = 2};
    default:
      return {.effect = effect};
  }
}

/// Resonance in Hz of two equal masses that a shaft of this stiffness joins.
inline double resonance_hz(double stiffness_nm_rad, double inertia_kgm2) {
  return math::sqrt(4.0 * stiffness_nm_rad / inertia_kgm2) / kTurnRad;
}

}  // namespace detail

/// The effect of that size, from the beginning. `size` in the catalogue's unit; for lags, delays, bandwidths,
/// backlash and shaft compliance > 0. A sine has phase 0, tooth passing has no second harmonic, a compliant
/// shaft joins two equal masses.
inline AppliedEffect applied(Effect effect, double size, const EffectScales<double>& scales) {
  AppliedEffect one{.form = detail::usual_form(effect, scales)};
  one.coefficient[0] = size;
  if (effect == Effect::kShaftCompliance) {
    one.form.shape = static_cast<float>(detail::resonance_hz(size, scales.inertia_kgm2));
    one.coefficient[0] = 1.0;
  }
  if (size_is_shape(effect)) {
    one.form.shape = static_cast<float>(size);
    one.coefficient[0] = 1.0;
  }
  return one;
}

/// The number that an engineer would state for it: amplitude where there are sine and cosine, stiffness of
/// the shaft from its resonance and its inertia ratio, slope where a law begins to bend.
inline double size_of(const AppliedEffect& one, const EffectScales<double>& scales) {
  const auto shape = static_cast<double>(one.form.shape);
  if (size_is_shape(one.form.effect)) return shape;
  if (one.form.effect == Effect::kShaftCompliance) {
    const double frequency_rad_s = detail::kTurnRad * shape;
    const double ratio = one.coefficient[0];
    return frequency_rad_s * frequency_rad_s * scales.inertia_kgm2 * ratio / ((1.0 + ratio) * (1.0 + ratio));
  }
  if (one.form.parts == 1 || may_be_refined(one.form.effect)) return one.coefficient[0];
  // An encoder that is not round is no more eccentric for it, a screw's harmonics are none of its amplitude.
  const bool is_once_per_turn =
      one.form.effect == Effect::kEncoderEccentricity || one.form.effect == Effect::kFeedScrewPeriodic;
  const std::size_t counted = is_once_per_turn ? 2 : one.form.parts;
  double power = 0.0;
  for (std::size_t i = 0; i < counted; ++i) power += one.coefficient[i] * one.coefficient[i];
  return math::sqrt(power);
}

/// The same effect, stated for a machine with another reference point: widths are shares of it, and a load
/// that grows with the speed is stated there.
inline AppliedEffect restated(AppliedEffect one, const EffectScales<double>& from,
                              const EffectScales<double>& to) {
  const auto widen = [&one](double ratio) { one.form.shape *= static_cast<float>(ratio); };
  const auto square = [](double ratio) { return ratio * ratio; };
  const double bent = one.coefficient[1];
  switch (one.form.effect) {
    case Effect::kSpindleCoulombFriction:
    case Effect::kSpindleStribeckFriction:
      if (is_bristle(one.form)) break;
      widen(from.speed_rad_s / to.speed_rad_s);
      break;
    case Effect::kFeedCoulombFriction:
    case Effect::kFeedStribeckFriction:
      widen(from.feed_speed_m_s / to.feed_speed_m_s);
      break;
    case Effect::kBrushVoltageDrop:
      widen(from.current_a / to.current_a);
      break;
    case Effect::kSpindleWindage:
      one.coefficient[1] *= to.speed_rad_s / from.speed_rad_s;
      one.coefficient[0] += one.coefficient[1] - bent;
      break;
    case Effect::kTorqueConstantSaturation:
      one.coefficient[1] *= square(to.current_a / from.current_a);
      break;
    case Effect::kFeedForceSaturation:
      one.coefficient[1] *= square(to.feed_force_n / from.feed_force_n);
      break;
    case Effect::kFeedAsymmetricFriction: {
      const double ratio = to.feed_speed_m_s / from.feed_speed_m_s;
      one.coefficient[0] = ratio * (one.coefficient[0] + bent * (ratio - 1.0));
      one.coefficient[1] *= square(ratio);
      break;
    }
    default:
      break;
  }
  return one;
}

}  // namespace morepro::gap
