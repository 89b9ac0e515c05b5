#pragma once
#include <array>
#include <optional>
#include <string_view>

#include "lib/gap/effect_info.hpp"

namespace morepro::gap {

/// The catalogue: every effect that the simulator can add and the diagnosis can name, in the order of Effect.
inline constexpr std::array<EffectInfo, kEffectCount> kEffects{
    EffectInfo{
        Effect::kSpindleCoulombFriction, "spindle_coulomb_friction", EffectGroup::kSpindleTorque, "N m",
        SizeRange::kAnySign, "M = -a tanh(w / 0.002 w0)", "reversals, or slow running",
        "Slow running in both directions: friction keeps its size, viscous and current errors do not."},
    EffectInfo{Effect::kSpindleStribeckFriction, "spindle_stribeck_friction", EffectGroup::kSpindleTorque,
               "N m", SizeRange::kAnySign, "M = -a tanh(50 x) exp(-x^2), x = w / 0.1 w0",
               "starts, stops and slow reversals",
               "Several slow speeds below a tenth of the cutting speed, each held for some 0.1 s."},
    EffectInfo{
        Effect::kSpindleWindage, "spindle_windage", EffectGroup::kSpindleTorque, "N m s2/rad2",
        SizeRange::kAnySign, "M = -a w |w|", "speed varied without contact",
        "Three or more speeds without contact: windage grows with the square, viscous friction does not."},
    EffectInfo{Effect::kSpindleCogging, "spindle_cogging", EffectGroup::kSpindleTorque, "N m",
               SizeRange::kAnySign, "M = -a sin(p th + phase), p periods per revolution (8)",
               "turning, slowly enough for the rate",
               "A spindle angle sensor, or slow running: cogging follows the angle, a resonance stays at its "
               "frequency."},
    EffectInfo{Effect::kToothPassingTorque, "tooth_passing_torque", EffectGroup::kSpindleTorque, "N m",
               SizeRange::kAnySign, "M = -Fc a sin(z th + phase), z teeth, and 2 z; run-out: 1, 2",
               "cuts at more than one speed",
               "Cuts at two speeds: tooth passing follows the angle and needs contact, cogging does not."},
    EffectInfo{Effect::kContactSpeedDependence, "contact_speed_dependence", EffectGroup::kSpindleTorque,
               "N m", SizeRange::kAnySign, "M = -Fc a tanh(w / 0.002 w0) (|w| / w0 - 1)",
               "speed varied in contact", "The same speed steps with and without contact."},
    EffectInfo{Effect::kContactChipLoadDependence, "contact_chip_load_dependence",
               EffectGroup::kSpindleTorque, "N m", SizeRange::kAnySign,
               "M = -Fc a tanh(w / 0.002 w0) (CL / CL0 - 1)", "chip load varied in contact",
               "Chip load steps at constant speed."},
    EffectInfo{Effect::kContactTemperatureDependence, "contact_temperature_dependence",
               EffectGroup::kSpindleTorque, "N m", SizeRange::kAnySign,
               "M = -Fc a tanh(w / 0.002 w0) (T - T0) / 100 K", "tool temperature varied in contact",
               "A tool that cools and heats several times: wear only grows, temperature comes back."},
    EffectInfo{Effect::kToolWearRamp, "tool_wear_ramp", EffectGroup::kSpindleTorque, "N m/s",
               SizeRange::kAnySign, "M = -Fc a tanh(w / 0.002 w0) t_cut, cutting time since it set in",
               "long cut", "A pause in the air: heating is gone after it, wear is not."},
    EffectInfo{
        Effect::kViscousTemperatureDependence, "viscous_temperature_dependence", EffectGroup::kSpindleTorque,
        "1/K", SizeRange::kAnySign, "M = -a b w (Tw - 25 degC), b the viscous friction",
        "winding or tool heats while turning",
        "Running at speed with and without current until the winding's temperature has changed by 20 K."},
    EffectInfo{Effect::kTorqueConstantSaturation, "torque_constant_saturation", EffectGroup::kSpindleTorque,
               "1/A2", SizeRange::kAnySign, "M = -a Kt i^3: Kt (1 - a i^2)", "currents far above the cut's",
               "Hard accelerations of both signs; a current sensor of known linearity."},
    EffectInfo{
        Effect::kShaftCompliance, "shaft_compliance", EffectGroup::kSpindleTorque, "N m/rad",
        SizeRange::kNotNegative, "M = (J2/J1) J x'', x'' + 0.1 W x' + W^2 x = torque/J, W^2 = a J/(J1 J2)",
        "torque steps or fast dither", "Fast voltage dither, sampled at five times the resonance or more."},
    EffectInfo{Effect::kFeedCoulombFriction, "feed_coulomb_friction", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -a tanh(v / 0.01 v0)", "feed reversals",
               "Strokes at three speeds in both directions: Stribeck with viscous friction bends with speed, "
               "Coulomb friction does not; presliding needs a position sensor at the reversals.",
               Aliases(Effect::kFeedStribeckFriction, Effect::kFeedPresliding)},
    EffectInfo{Effect::kFeedViscousFriction, "feed_viscous_friction", EffectGroup::kFeedForce, "N s/m",
               SizeRange::kAnySign, "F = -a v", "feed speed varied",
               "Strokes at three speeds in both directions."},
    EffectInfo{Effect::kFeedStribeckFriction, "feed_stribeck_friction", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -a tanh(30 x) exp(-x^2), x = v / 0.3 v0", "slow feed reversals",
               "Strokes at three speeds, one of them below a tenth of the working feed.",
               Aliases(Effect::kFeedCoulombFriction)},
    EffectInfo{
        Effect::kFeedAsymmetricFriction, "feed_asymmetric_friction", EffectGroup::kFeedForce, "N",
        SizeRange::kAnySign, "F = -a |v| / v0", "two speeds in each direction",
        "Two speeds in each direction: an offset stays the same, asymmetric friction grows with speed."},
    EffectInfo{Effect::kFeedForceOffset, "feed_force_offset", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -a", "feed reversals",
               "Feed in both directions: an offset keeps its sign, Coulomb friction changes it."},
    EffectInfo{Effect::kFeedScrewPeriodic, "feed_screw_periodic", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -a sin(2 pi x / pitch + phase), pitch 5 mm if unknown",
               "strokes over several screw turns",
               "The screw's pitch in the machine file, and strokes over several turns."},
    EffectInfo{Effect::kFeedCuttingSpeedDependence, "feed_cutting_speed_dependence", EffectGroup::kFeedForce,
               "N", SizeRange::kAnySign, "F = -Fc a (|w| / w0 - 1)", "speed varied in contact",
               "Spindle speed steps in contact at constant feed, and feed steps at constant spindle speed."},
    EffectInfo{Effect::kFeedToothPassingForce, "feed_tooth_passing_force", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -Fc a sin(z th + phase), z teeth, and 2 z; run-out: 1, 2",
               "cuts at more than one speed",
               "Cuts at two spindle speeds, sampled at four times the tooth frequency or more."},
    EffectInfo{Effect::kFeedSpring, "feed_spring", EffectGroup::kFeedForce, "N/m", SizeRange::kAnySign,
               "F = -a (x - x0), x0 where it rests: the first position, if unknown", "long strokes",
               "Strokes over the whole travel: a spring follows the place, friction the direction."},
    EffectInfo{Effect::kFeedContactDrift, "feed_contact_drift", EffectGroup::kFeedForce, "N",
               SizeRange::kAnySign, "F = -Fc a t_cut / 10 s, cutting time since it set in", "long cut",
               "Contact on and off during a long run: drift grows in contact only."},
    EffectInfo{Effect::kFeedForceSaturation, "feed_force_saturation", EffectGroup::kFeedForce, "1/N2",
               SizeRange::kAnySign, "F = -a F1^3: F1 (1 - a F1^2)", "forces far above the cut's",
               "Hard accelerations in both directions."},
    EffectInfo{Effect::kFeedDriveLag, "feed_drive_lag", EffectGroup::kFeedForce, "s", SizeRange::kNotNegative,
               "F = lagged(F1) - F1, time constant a", "force dither",
               "A position or acceleration sensor of its own; contact on and off: the cutting force passes "
               "the sensor but not the drive.",
               Aliases(Effect::kFeedSpeedDelay)},
    EffectInfo{Effect::kFeedBacklash, "feed_backlash", EffectGroup::kFeedForce, "m", SizeRange::kNotNegative,
               "F = m/2 u', u' = 2/m (F1 + bx v + load) in the play a, u = 0 at its ends",
               "feed force reversals", "A position sensor at the slide as well as at the motor."},
    EffectInfo{Effect::kFeedPresliding, "feed_presliding", EffectGroup::kFeedForce, "N", SizeRange::kAnySign,
               "F = -a z, dz/dx = (sign(v) - z) / 50 um (Dahl)", "small feed reversals",
               "Reversals of some 10 um with a position sensor.", Aliases(Effect::kFeedCoulombFriction)},
    EffectInfo{Effect::kBrushVoltageDrop,
               "brush_voltage_drop",
               EffectGroup::kArmatureVoltage,
               "V",
               SizeRange::kAnySign,
               "U = -a tanh(i / 0.02 i0)",
               "current through zero",
               "Stall or slow running with a current sensor: friction needs motion, the drop does not; the "
               "voltage at the motor tells brushes from the inverter.",
               {},
               "inverter dead time"},
    EffectInfo{Effect::kResistanceTemperatureDrift, "resistance_temperature_drift",
               EffectGroup::kArmatureVoltage, "1/K", SizeRange::kAnySign, "U = -a R i (Tw - 25 degC)",
               "winding heats; large currents",
               "A winding temperature sensor, and current and speed varied against each other."},
    EffectInfo{Effect::kInductanceSaturation, "inductance_saturation", EffectGroup::kArmatureVoltage, "1/A2",
               SizeRange::kAnySign, "U = a L i^2 di/dt, di/dt of the nominal model",
               "fast voltage dither at large current", "Fast voltage steps at two currents."},
    EffectInfo{Effect::kSupplyVoltageOffset, "supply_voltage_offset", EffectGroup::kArmatureVoltage, "V",
               SizeRange::kAnySign, "U = a", "reversals",
               "Standstill without voltage: only the speed sensor's bias shows there; or an angle sensor.",
               Aliases(Effect::kSpindleSpeedBias)},
    EffectInfo{Effect::kDriveLag, "drive_lag", EffectGroup::kArmatureVoltage, "s", SizeRange::kNotNegative,
               "U = lagged(V) - V, time constant a", "fast voltage dither",
               "The voltage measured at the armature, or dither that is faster than the current loop.",
               Aliases(Effect::kCurrentDelay, Effect::kCurrentBandwidth)},
    EffectInfo{Effect::kArmatureReaction, "armature_reaction", EffectGroup::kArmatureVoltage, "1/A",
               SizeRange::kAnySign, "U = a Kv w |i|, M = -a Kt i |i|", "current varied at speed",
               "Loads and reversals at full speed; no load at the same speed."},
    EffectInfo{Effect::kMagnetTemperatureDrift, "magnet_temperature_drift", EffectGroup::kArmatureVoltage,
               "1/K", SizeRange::kAnySign, "U = a Kv w (Tw - 25 degC), M = -a Kt i (Tw - 25 degC)",
               "winding heats while turning",
               "A winding temperature sensor, and running at speed hot and cold."},
    EffectInfo{Effect::kSpindleSpeedBias, "spindle_speed_bias", EffectGroup::kSensor, "rad/s",
               SizeRange::kAnySign, "w measured = w + a", "reversals",
               "Standstill without voltage, or an angle sensor.", Aliases(Effect::kSupplyVoltageOffset)},
    EffectInfo{Effect::kCurrentBias, "current_bias", EffectGroup::kSensor, "A", SizeRange::kAnySign,
               "i measured = i + a", "reversals", "Standstill without voltage: the current must be zero."},
    EffectInfo{Effect::kSpindleSpeedDelay, "spindle_speed_delay", EffectGroup::kSensor, "s",
               SizeRange::kNotNegative, "w measured(t) = w(t - a)", "fast voltage dither",
               "Dither up to the frequency 1/a: a delay keeps the amplitude, a bandwidth does not.",
               Aliases(Effect::kSpindleSpeedBandwidth)},
    EffectInfo{
        Effect::kCurrentDelay, "current_delay", EffectGroup::kSensor, "s", SizeRange::kNotNegative,
        "i measured(t) = i(t - a)", "fast voltage dither",
        "Dither up to the frequency 1/a: a delay keeps the amplitude; the voltage measured at the armature.",
        Aliases(Effect::kDriveLag, Effect::kCurrentBandwidth)},
    EffectInfo{Effect::kFeedSpeedDelay, "feed_speed_delay", EffectGroup::kSensor, "s",
               SizeRange::kNotNegative, "v measured(t) = v(t - a)", "force dither",
               "A position or acceleration sensor of its own; contact on and off: the cutting force passes "
               "the sensor but not the drive.",
               Aliases(Effect::kFeedDriveLag)},
    EffectInfo{Effect::kSpindleSpeedBandwidth, "spindle_speed_bandwidth", EffectGroup::kSensor, "s",
               SizeRange::kNotNegative, "w measured = lagged(w), time constant a", "fast voltage dither",
               "Dither up to the frequency 1/a: a bandwidth takes amplitude, a delay does not.",
               Aliases(Effect::kSpindleSpeedDelay)},
    EffectInfo{
        Effect::kCurrentBandwidth, "current_bandwidth", EffectGroup::kSensor, "s", SizeRange::kNotNegative,
        "i measured = lagged(i), time constant a", "fast voltage dither",
        "Dither up to the frequency 1/a: a bandwidth takes amplitude; the voltage measured at the armature.",
        Aliases(Effect::kDriveLag, Effect::kCurrentDelay)},
    EffectInfo{
        Effect::kEncoderEccentricity, "encoder_eccentricity", EffectGroup::kSensor, "1", SizeRange::kAnySign,
        "w measured = w (1 + a sin(th + phase))", "turning, slowly enough for the rate",
        "Two speeds: the error is a fixed share of the speed at one period per revolution; cogging is not."},
    EffectInfo{Effect::kCurrentNonlinearity, "current_nonlinearity", EffectGroup::kSensor, "1/A",
               SizeRange::kAnySign, "i measured = i + a i |i|", "currents far above the cut's",
               "A reference current at two levels."},
    EffectInfo{Effect::kSensorQuantization, "sensor_quantization", EffectGroup::kSensor, "lsb",
               SizeRange::kNotNegative, "w, i, v rounded to a lsb (without an lsb: to a standard deviations)",
               "none", "Standstill: the values that occur are whole multiples of the step."},
    EffectInfo{Effect::kClockJitter, "clock_jitter", EffectGroup::kSampling, "s", SizeRange::kNotNegative,
               "sampled at t + a n, n normal; time stamps nominal", "fast changes of the signals",
               "Fast changes against standstill: jitter grows with the rate of change, noise does not."},
    EffectInfo{Effect::kSampleDropout, "sample_dropout", EffectGroup::kSampling, "1", SizeRange::kFraction,
               "that fraction of the rows is not written", "none", "The time stamps themselves."},
};

/// Row of an effect that has a name: index_of(effect) < kEffectCount.
constexpr const EffectInfo& info_of(Effect effect) { return kEffects[index_of(effect)]; }
constexpr std::string_view name_of(Effect effect) { return info_of(effect).name; }

/// The effect of that name; nothing for another one.
constexpr std::optional<Effect> effect_named(std::string_view name) {
  for (const EffectInfo& info : kEffects) {
    if (info.name == name) return info.effect;
  }
  return std::nullopt;
}

namespace detail {

constexpr bool is_ordered() {
  for (std::size_t i = 0; i < kEffectCount; ++i) {
    if (index_of(kEffects[i].effect) != i) return false;
  }
  return true;
}

constexpr bool has_unique_names() {
  for (const EffectInfo& info : kEffects) {
    if (effect_named(info.name) != info.effect) return false;
  }
  return true;
}

constexpr bool has_symmetric_aliases() {
  for (const EffectInfo& info : kEffects) {
    for (const Effect alias : info.aliases.list()) {
      if (alias == info.effect || !info_of(alias).aliases.contains(info.effect)) return false;
    }
  }
  return true;
}

}  // namespace detail

static_assert(detail::is_ordered());
static_assert(detail::has_unique_names());
static_assert(detail::has_symmetric_aliases());

}  // namespace morepro::gap
