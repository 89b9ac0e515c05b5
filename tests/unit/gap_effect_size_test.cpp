#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "lib/plant/built_in_machines.hpp"

namespace morepro::gap {
namespace {

// A shape is a float.
constexpr double kFloatError = 2.0e-7;

EffectScales<double> scales() {
  return {reference_machine(),
          {.speed_rad_s = 577.7,
           .current_a = 2.2,
           .feed_speed_m_s = 0.018,
           .chip_load_mm = 0.05,
           .tool_degc = 500}};
}

TEST(EffectSize, ComesBackForEveryEffect) {
  for (const EffectInfo& info : kEffects) {
    for (const double size : {0.003, 25.0}) {
      EXPECT_NEAR(size_of(applied(info.effect, size, scales()), scales()), size, kFloatError * size)
          << info.name;
    }
  }
}

TEST(EffectSize, ChangesWithItsSignWhereItHasOne) {
  for (const EffectInfo& info : kEffects) {
    if (info.range != SizeRange::kAnySign) continue;
    const AppliedEffect one = applied(info.effect, -0.5, scales());
    EXPECT_EQ(one.coefficient[0], -0.5) << info.name;
    EXPECT_EQ(size_of(one, scales()), one.form.parts == 1 ? -0.5 : 0.5) << info.name;
  }
}

TEST(EffectSize, OfSineAndCosineIsTheAmplitude) {
  AppliedEffect cogging = applied(Effect::kSpindleCogging, 1.0, scales());
  cogging.coefficient = {0.3, -0.4};
  EXPECT_NEAR(size_of(cogging, scales()), 0.5, 1e-15);
}

TEST(EffectSize, OfAnEccentricityIsThatOnceATurn) {
  AppliedEffect one{.form = {.effect = Effect::kEncoderEccentricity, .parts = 4},
                    .coefficient = {0.3, -0.4, 0.2, 0.1}};
  EXPECT_NEAR(size_of(one, scales()), 0.5, 1e-15);
}

TEST(EffectSize, OfAShaftIsTheStiffnessBetweenAnyTwoMasses) {
  // k = W^2 J1 J2 / (J1 + J2), here with J2 = 3 J1 and a resonance of 100 Hz.
  const double inertia = reference_machine().spindle.inertia_kgm2;
  const double first = inertia / 4.0;
  const double second = 3.0 * inertia / 4.0;
  AppliedEffect shaft{.form = {.effect = Effect::kShaftCompliance, .shape = 100.0F}, .coefficient = {3.0}};
  const double expected = std::pow(200.0 * std::numbers::pi, 2) * first * second / inertia;
  EXPECT_NEAR(size_of(shaft, scales()), expected, 1e-12 * expected);
}

TEST(EffectSize, OfAScrewTakesAUsualPitchWhereTheMachineHasNone) {
  EXPECT_EQ(applied(Effect::kFeedScrewPeriodic, 1.0, scales()).form.shape, 5.0e-3F);
  MachineParameters machine = reference_machine();
  machine.feed.screw_pitch_m = 0.01;
  EXPECT_EQ(applied(Effect::kFeedScrewPeriodic, 1.0, {machine, {}}).form.shape, 0.0F);
}

/// Contribution of one step.
Contribution<double> after(const AppliedEffect& effect, const EffectSignals<double>& signals) {
  AppliedTerm<double, 8> term(effect, scales(), 1.0e-4);
  Contribution<double> sum;
  term.step(signals, sum);
  return sum;
}

struct Law {
  Effect effect;
  double Contribution<double>::*where;
  double value;
};

TEST(AppliedEffect, FollowsTheEquationOfTheCatalogue) {
  // Away from every friction width and from the reference point, so that each term counts.
  const EffectSignals<double> s{.cutting_time_s = 4.0,
                                .feed_force_n = 12.0,
                                .contact = 1.0,
                                .chip_load_mm = 0.06,
                                .speed_rad_s = -300.0,
                                .angle_rad = 0.3,
                                .current_a = -4.0,
                                .feed_speed_m_s = -0.009,
                                .feed_position_m = 0.0012,
                                .tool_degc = 450.0,
                                .winding_degc = 65.0,
                                .acceleration_rad_s2 = 1000.0,
                                .current_rate_a_s = 500.0};
  using C = Contribution<double>;
  const Law laws[] = {
      {Effect::kSpindleCoulombFriction, &C::torque_nm, 2.0},
      {Effect::kSpindleStribeckFriction, &C::torque_nm, 2.0 * std::exp(-std::pow(300.0 / 57.77, 2))},
      {Effect::kSpindleWindage, &C::torque_nm, 2.0 * 9.0e4},
      {Effect::kSpindleCogging, &C::torque_nm, -2.0 * std::sin(8.0 * 0.3)},
      {Effect::kToothPassingTorque, &C::torque_nm, -2.0 * std::sin(4.0 * 0.3)},
      {Effect::kContactSpeedDependence, &C::torque_nm, 2.0 * (300.0 / 577.7 - 1.0)},
      {Effect::kContactChipLoadDependence, &C::torque_nm, 2.0 * 0.2},
      {Effect::kContactTemperatureDependence, &C::torque_nm, 2.0 * -0.5},
      {Effect::kToolWearRamp, &C::torque_nm, 2.0 * 4.0},
      {Effect::kViscousTemperatureDependence, &C::torque_nm, 2.0 * 1.0e-4 * 300.0 * 40.0},
      {Effect::kTorqueConstantSaturation, &C::torque_nm, 2.0 * 0.08 * 64.0},
      {Effect::kFeedCoulombFriction, &C::force_n, 2.0},
      {Effect::kFeedViscousFriction, &C::force_n, 2.0 * 0.009},
      {Effect::kFeedStribeckFriction, &C::force_n, 2.0 * std::exp(-std::pow(0.5 / 0.3, 2))},
      {Effect::kFeedAsymmetricFriction, &C::force_n, -2.0 * 0.5},
      {Effect::kFeedForceOffset, &C::force_n, -2.0},
      {Effect::kFeedScrewPeriodic, &C::force_n, -2.0 * std::sin(2.0 * std::numbers::pi * 0.24)},
      {Effect::kFeedCuttingSpeedDependence, &C::force_n, -2.0 * (300.0 / 577.7 - 1.0)},
      {Effect::kFeedToothPassingForce, &C::force_n, -2.0 * std::sin(4.0 * 0.3)},
      {Effect::kFeedSpring, &C::force_n, -2.0 * 0.0012},
      {Effect::kFeedContactDrift, &C::force_n, -2.0 * 0.4},
      {Effect::kFeedForceSaturation, &C::force_n, -2.0 * 1728.0},
      {Effect::kBrushVoltageDrop, &C::voltage_v, 2.0},
      {Effect::kResistanceTemperatureDrift, &C::voltage_v, 2.0 * 0.8 * 4.0 * 40.0},
      {Effect::kInductanceSaturation, &C::voltage_v, 2.0 * 0.5e-3 * 16.0 * 500.0},
      {Effect::kSupplyVoltageOffset, &C::voltage_v, 2.0},
      {Effect::kArmatureReaction, &C::voltage_v, -2.0 * 0.08 * 300.0 * 4.0},
      {Effect::kArmatureReaction, &C::torque_nm, 2.0 * 0.08 * 16.0},
      {Effect::kMagnetTemperatureDrift, &C::voltage_v, -2.0 * 0.08 * 300.0 * 40.0},
      {Effect::kMagnetTemperatureDrift, &C::torque_nm, 2.0 * 0.08 * 4.0 * 40.0},
      {Effect::kSpindleSpeedBias, &C::speed_rad_s, 2.0},
      {Effect::kCurrentBias, &C::current_a, 2.0},
      {Effect::kEncoderEccentricity, &C::speed_rad_s, -2.0 * 300.0 * std::sin(0.3)},
      {Effect::kCurrentNonlinearity, &C::current_a, -2.0 * 16.0},
  };
  for (const Law& law : laws) {
    const double made = after(applied(law.effect, 2.0, scales()), s).*law.where;
    // The screw's pitch is a float.
    EXPECT_NEAR(made, law.value, 1.0e-6 * std::fabs(law.value)) << name_of(law.effect);
  }
}

TEST(AppliedEffect, BendsByItsSecondPart) {
  const EffectSignals<double> s{.cutting_time_s = 4.0,
                                .feed_force_n = 12.0,
                                .contact = 1.0,
                                .chip_load_mm = 0.06,
                                .speed_rad_s = -300.0,
                                .current_a = -4.0,
                                .feed_speed_m_s = -0.009,
                                .tool_degc = 450.0};
  struct Bend {
    Effect effect;
    std::uint8_t kind;
    double share;  ///< of the second part in the first
  };
  const double force = 12.0 / scales().feed_force_n;
  // What is gone beyond three times the range, over what is gone beyond the range itself.
  const auto wider = [](double speed, double range) {
    return std::expm1(8.0 / 9.0 * std::pow(speed / range, 2));
  };
  const Bend bends_of[] = {
      {Effect::kSpindleStribeckFriction, 0, wider(300.0, static_cast<double>(0.1F) * scales().speed_rad_s)},
      {Effect::kFeedStribeckFriction, 0, wider(0.009, static_cast<double>(0.3F) * scales().feed_speed_m_s)},
      {Effect::kSpindleWindage, 0, 300.0 / 577.7 - 1.0},
      {Effect::kContactSpeedDependence, 0, 300.0 / 577.7 - 1.0},
      {Effect::kContactChipLoadDependence, 0, 0.2},
      {Effect::kContactTemperatureDependence, 0, -0.5},
      {Effect::kToolWearRamp, 0, 0.4},
      {Effect::kTorqueConstantSaturation, 0, std::pow(4.0 / 2.2, 2)},
      {Effect::kFeedCuttingSpeedDependence, 0, 300.0 / 577.7 - 1.0},
      {Effect::kFeedCuttingSpeedDependence, 1, -0.5},
      {Effect::kFeedContactDrift, 0, 0.4},
      {Effect::kFeedForceSaturation, 0, force * force},
      {Effect::kFeedAsymmetricFriction, 0, 0.009 / scales().feed_speed_m_s - 1.0},
  };
  std::size_t effects = 0;
  for (const EffectInfo& info : kEffects) effects += bends(info.effect) ? 1 : 0;
  EXPECT_EQ(effects + 1, std::size(bends_of)) << "one of them has two kinds";
  for (const auto& [effect, kind, share] : bends_of) {
    AppliedEffect one = applied(effect, 2.0, scales());
    one.form.kind = kind;
    const Contribution<double> plain = after(one, s);
    one.form.parts = 2;
    one.coefficient[1] = 3.0;
    EXPECT_EQ(size_of(one, scales()), 2.0) << name_of(effect);
    const Contribution<double> bent = after(one, s);
    const double wanted = (plain.torque_nm + plain.force_n) * (1.0 + 1.5 * share);
    EXPECT_NE(wanted, 0.0);
    EXPECT_NEAR(bent.torque_nm + bent.force_n, wanted, 1.0e-12 * std::fabs(wanted)) << name_of(effect);
  }
}

// Slow speeds are where friction of this sort changes its side.
TEST(EffectSize, OfStribeckFrictionIsTheSameCurveAtAnotherReferencePoint) {
  const EffectScales<double> other{reference_machine(), {.speed_rad_s = 350.0, .feed_speed_m_s = 0.005}};
  for (const Effect effect : {Effect::kSpindleStribeckFriction, Effect::kFeedStribeckFriction}) {
    AppliedEffect one = applied(effect, 2.0, scales());
    one.form.parts = 2;
    one.coefficient[1] = 0.7;
    const AppliedEffect again = restated(one, scales(), other);
    for (const double share : {-0.5, -0.01, 0.001, 0.004, 0.03, 0.2}) {
      const EffectSignals<double> s{.speed_rad_s = share * scales().speed_rad_s,
                                    .feed_speed_m_s = share * scales().feed_speed_m_s};
      const Contribution<double> there = after(one, s);
      AppliedTerm<double, 16> term(again, other, 1.0e-4);
      Contribution<double> here;
      term.step(s, here);
      // The range is a float.
      EXPECT_NEAR(here.torque_nm + here.force_n, there.torque_nm + there.force_n, 1.0e-6)
          << name_of(effect) << " at " << share;
    }
  }
}

// The file knows no reference point, the recording has one: what is found with one has to act the same when
// it is stated with the other.
TEST(EffectSize, OfABentLawIsTheSameLawAtAnotherReferencePoint) {
  const EffectScales<double> other{reference_machine(),
                                   {.speed_rad_s = 350.0,
                                    .current_a = 3.1,
                                    .feed_speed_m_s = 0.01,
                                    .chip_load_mm = 0.05,
                                    .tool_degc = 500,
                                    .feed_force_n = 40.0}};
  const EffectSignals<double> s{
      .feed_force_n = 30.0, .contact = 1.0, .speed_rad_s = 500.0, .current_a = 2.5, .feed_speed_m_s = 0.02};
  for (const Effect effect :
       {Effect::kSpindleWindage, Effect::kTorqueConstantSaturation, Effect::kFeedForceSaturation}) {
    const AppliedEffect one{.form = {.effect = effect, .parts = 2}, .coefficient = {2.0, 3.0}};
    const auto acting = [&s](const AppliedEffect& applied, const EffectScales<double>& k) {
      AppliedTerm<double, 8> term(applied, k, 1.0e-4);
      Contribution<double> sum;
      term.step(s, sum);
      return sum.torque_nm + sum.force_n;
    };
    const double here = acting(one, scales());
    EXPECT_NEAR(acting(restated(one, scales(), other), other), here, 1.0e-12 * std::fabs(here))
        << name_of(effect);
  }
}

TEST(AppliedEffect, HasItsSizeAtTheReferencePoint) {
  const EffectSignals<double> twice_as_fast{.contact = 1.0, .speed_rad_s = 2.0 * 577.7};
  EXPECT_NEAR(after(applied(Effect::kContactSpeedDependence, 0.1, scales()), twice_as_fast).torque_nm, -0.1,
              1e-12);
  const EffectSignals<double> hotter{.contact = 1.0, .speed_rad_s = 577.7, .tool_degc = 600.0};
  EXPECT_NEAR(after(applied(Effect::kContactTemperatureDependence, 0.1, scales()), hotter).torque_nm, -0.1,
              1e-12);
  const EffectSignals<double> feeding{.feed_speed_m_s = 0.018};
  EXPECT_NEAR(after(applied(Effect::kFeedAsymmetricFriction, 5.0, scales()), feeding).force_n, -5.0, 1e-12);
  const EffectSignals<double> ten_seconds{.cutting_time_s = 10.0, .contact = 1.0};
  EXPECT_NEAR(after(applied(Effect::kFeedContactDrift, 5.0, scales()), ten_seconds).force_n, -5.0, 1e-12);
}

TEST(AppliedEffect, OfCuttingTimeGrowsFromItsOnset) {
  AppliedEffect ramp = applied(Effect::kToolWearRamp, 0.1, scales());
  ramp.onset_s = 2.0;
  AppliedTerm<double, 0> term(ramp, scales(), 1.0);
  Contribution<double> before, at_onset, later;
  term.step({.time_s = 1.0, .cutting_time_s = 1.0, .contact = 1.0, .speed_rad_s = 577.7}, before);
  term.step({.time_s = 2.0, .cutting_time_s = 2.0, .contact = 1.0, .speed_rad_s = 577.7}, at_onset);
  term.step({.time_s = 5.0, .cutting_time_s = 4.0, .contact = 1.0, .speed_rad_s = 577.7}, later);
  EXPECT_EQ(before.torque_nm, 0.0);
  EXPECT_NEAR(at_onset.torque_nm, -0.1, 1e-12);
  EXPECT_NEAR(later.torque_nm, -0.3, 1e-12);
}

TEST(AppliedEffect, InFloatIsThatInDouble) {
  const EffectSignals<float> signals{.contact = 1.0F,
                                     .chip_load_mm = 0.06F,
                                     .speed_rad_s = 300.0F,
                                     .angle_rad = 1.3F,
                                     .current_a = 4.0F,
                                     .feed_speed_m_s = 0.01F,
                                     .feed_position_m = 0.003F,
                                     .tool_degc = 470.0F,
                                     .winding_degc = 60.0F};
  const EffectSignals<double> exact{.contact = 1.0,
                                    .chip_load_mm = 0.06,
                                    .speed_rad_s = 300.0,
                                    .angle_rad = 1.3,
                                    .current_a = 4.0,
                                    .feed_speed_m_s = 0.01,
                                    .feed_position_m = 0.003,
                                    .tool_degc = 470.0,
                                    .winding_degc = 60.0};
  const EffectScales<float> rounded(reference_machine(), {577.7, 2.2, 0.018, 0.05, 500.0, 25.0});
  for (const EffectInfo& info : kEffects) {
    const AppliedEffect one = applied(info.effect, 1.0, scales());
    AppliedTerm<float, 8> term(one, rounded, 1.0e-4);
    Contribution<float> sum;
    term.step(signals, sum);
    const Contribution<double> wanted = after(one, exact);
    // Some ten roundings, on sums of the size of the signals.
    const auto near = [](double value) { return 2.0e-6 * (std::fabs(value) + 1.0); };
    EXPECT_NEAR(static_cast<double>(sum.torque_nm), wanted.torque_nm, near(wanted.torque_nm)) << info.name;
    EXPECT_NEAR(static_cast<double>(sum.force_n), wanted.force_n, near(wanted.force_n)) << info.name;
    EXPECT_NEAR(static_cast<double>(sum.voltage_v), wanted.voltage_v, near(wanted.voltage_v)) << info.name;
    EXPECT_NEAR(static_cast<double>(sum.speed_rad_s), wanted.speed_rad_s, near(wanted.speed_rad_s))
        << info.name;
    EXPECT_NEAR(static_cast<double>(sum.current_a), wanted.current_a, near(wanted.current_a)) << info.name;
  }
}

}  // namespace
}  // namespace morepro::gap
