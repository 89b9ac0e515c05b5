#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sim_host/diagnose/outcome/shaking_clock.hpp"
#include "sim_host/simulate/simulated_machine.hpp"
#include "tests/unit/driven_spindle.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::diagnosed;
using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::said;
using diagnose_test::SimulatedRun;
using gap::Effect;

constexpr double kClockJitterS = 5.0e-6;

SimulatedRun shaken_clock(double process_noise = 0.0, double jitter_s = kClockJitterS) {
  return {
      .effects = {effect(Effect::kClockJitter, jitter_s)}, .duration_s = 2.0, .process_noise = process_noise};
}

// The larger one is three times the current's noise at its edges: the process noise that was fitted without
// it has to be found anew.
TEST(ClockJitter, IsNamedAloneWithItsSize) {
  for (const double jitter_s : {kClockJitterS, 3.0 * kClockJitterS}) {
    const auto result = diagnosed(record(shaken_clock(0.5, jitter_s)), datasheet(0.1));
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which[0].effect, Effect::kClockJitter);
    EXPECT_NEAR(result.which[0].magnitude, jitter_s, 3.0 * result.which[0].standard_error);
    // What a sample's instant between two inputs leaves open is 5 % (clock_jitter.cpp).
    EXPECT_LT(result.which[0].standard_error, 0.1 * jitter_s);
  }
}

// The instants jitter, and are late on average: two names, and no gap of the feed, which had a residual ratio
// of 38, before and after, and in other recordings made the lag the name that closes nothing: "unexplained".
TEST(ClockJitter, LeavesNoStructureBesideALag) {
  const auto result = diagnosed(
      record({.effects = {effect(Effect::kClockJitter, 1.0e-4), effect(Effect::kCurrentDelay, 5.0e-5)},
              .duration_s = 6.0,
              .rate_hz = 2000.0}),
      datasheet(0.2));
  EXPECT_EQ(result.verdict, Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kClockJitter);
  for (const BalanceResult& balance : result.where)
    EXPECT_LT(balance.residual_ratio_after, 1.2) << gap::name_of(balance.balance);
}

// What it leaves is no structure; another machine from some time on, and what rings, are none of it.
TEST(ClockJitter, HidesNoOtherMachine) {
  const RecordingSignals signals;
  const AxisFit fit{Axis::kFeed, signals, {}};
  std::vector<AxisOutcome> outcomes(3, AxisOutcome{.diagnosis = {.fit = fit, .nominal = fit}});
  for (AxisOutcome& outcome : outcomes) outcome.leftover.gain = 1000.0;
  outcomes[1].leftover.changed_values = "the machine's values";
  outcomes[2].leftover.ringing_hz = 40.0;
  forget_what_clock_leaves({{.effect = Effect::kSampleDropout}}, outcomes);
  EXPECT_EQ(outcomes[0].leftover.gain, 1000.0) << "its clock does not shake";
  forget_what_clock_leaves({{.effect = Effect::kClockJitter}}, outcomes);
  EXPECT_EQ(outcomes[0].leftover.gain, 0.0);
  EXPECT_EQ(outcomes[1].leftover.gain, 1000.0);
  EXPECT_EQ(outcomes[2].leftover.gain, 1000.0);
}

// What a law without a name leaves of a sensor's neighbours looks like a hair of jitter: 0.8 us of 500.
TEST(ClockJitter, IsNoNameBesideMuchMoreStructureThanItLeaves) {
  const RecordingSignals signals;
  const AxisFit fit{Axis::kFeed, signals, {}};
  std::vector<AxisOutcome> outcomes(2, AxisOutcome{.diagnosis = {.fit = fit, .nominal = fit}});
  SamplingFault jitter{.effect = Effect::kClockJitter};
  jitter.evidence = 100.0;
  EXPECT_TRUE(is_worth_its_name(jitter, outcomes)) << "nothing else is there";
  outcomes[1].leftover.gain = 450.0;
  EXPECT_TRUE(is_worth_its_name(jitter, outcomes)) << "as much as clocks leave that shake";
  outcomes[1].leftover.gain = 1800.0;
  EXPECT_FALSE(is_worth_its_name(jitter, outcomes));
  outcomes[1].leftover.ringing_hz = 40.0;
  EXPECT_TRUE(is_worth_its_name(jitter, outcomes)) << "that is told beside a clock";
}

// A file that knows of the jitter knows what it leaves.
TEST(ClockJitter, LeavesNoStructureWhereItIsKnown) {
  MachineDescription machine = datasheet(0.0);
  machine.effects = {effect(Effect::kClockJitter, 1.0e-4)};
  const auto result =
      diagnosed(record({.effects = machine.effects, .duration_s = 6.0, .rate_hz = 2000.0}), machine);
  EXPECT_EQ(result.verdict, Verdict::kNoGap) << said(result);
}

// A quarter of an interval: process noise takes nearly all of it, and gives it back with the other sign.
TEST(ClockJitter, IsNamedWhereProcessNoiseHasTakenIt) {
  constexpr double kLargeS = 25.0e-6;
  const auto result = diagnosed(record(shaken_clock(0.0, kLargeS)), datasheet(0.1));
  ASSERT_FALSE(result.which.empty()) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kClockJitter) << said(result);
  EXPECT_EQ(result.verdict, Verdict::kEffect);
  EXPECT_NEAR(result.which.front().magnitude, kLargeS, 0.2 * kLargeS);
}

// A position that moves fast is ten deviations off. The current, whose rate jumps with its voltage, shares
// more with its neighbour than a jitter does, and the position nothing; it was "unexplained".
TEST(ClockJitter, IsNamedByTheSensorThatKnowsItBest) {
  constexpr double kJitterS = 9.0e-5;
  const auto result = diagnosed(
      record({.effects = {effect(Effect::kClockJitter, kJitterS)}, .duration_s = 15.0, .rate_hz = 2000.0}),
      datasheet(0.0));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kClockJitter);
  EXPECT_NEAR(result.which.front().magnitude, kJitterS, 0.2 * kJitterS);
}

/// A spindle whose samples and inputs hang on one clock that shakes: an interval is as long as its two
/// instants are apart.
RecordingSignals on_a_shaken_clock(double jitter_s) {
  constexpr double kStepS = 2.0e-6;
  constexpr double kMost = 0.4;  // of an interval
  RecordingSignals signals;
  signals.rate_hz = 10000.0;
  signals.rows = 30000;
  const double period_s = 1.0 / signals.rate_hz;
  SimulatedMachine machine(reference_machine(), kStepS);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Sensors sensors = reference_sensors();
  PlantInput<double> input;
  double late_s = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    if (row % 10 == 0) input.armature_voltage_v = random() % 2 == 0 ? 30.0 : 18.0;
    const auto push = [&](Channel channel, double value) {
      signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(channel));
      signals.value[index_of(channel)].push_back(
          static_cast<float>(value + sensors[channel].noise * normal(random)));
    };
    push(Channel::kArmatureVoltage, input.armature_voltage_v);
    push(Channel::kSpindleSpeed, machine.state().speed_rad_s);
    push(Channel::kArmatureCurrent, machine.state().current_a);
    const double next_late_s = std::clamp(jitter_s * normal(random), -kMost * period_s, kMost * period_s);
    const auto steps = std::lround((period_s + next_late_s - late_s) / kStepS);
    late_s += static_cast<double>(steps) * kStepS - period_s;
    for (long i = 0; i < steps; ++i) machine.step(input);
  }
  return signals;
}

// Neighbours share a third of it, more than of samples that alone are taken at the wrong time: "unexplained".
TEST(ClockJitter, MayShakeInputsAndSamplesAlike) {
  constexpr double kJitterS = 5.0e-5;
  const auto result = diagnosed(on_a_shaken_clock(kJitterS), datasheet(0.1));
  EXPECT_EQ(result.verdict, Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kClockJitter) << said(result);
}

TEST(ClockJitter, ShowsInTheVoltageBalance) {
  const auto result = diagnosed(record(shaken_clock()), datasheet(0.0));
  for (const BalanceResult& balance : result.where)
    EXPECT_EQ(balance.is_significant, balance.balance == gap::Balance::kArmatureVoltage);
}

TEST(ClockJitter, IsToldFromRandomLoadAndRipple) {
  EXPECT_EQ(diagnosed(record({.duration_s = 2.0, .process_noise = 1.0}), datasheet(0.0)).verdict,
            Verdict::kNoGap);
  const auto result = diagnosed(record(shaken_clock(1.0)), datasheet(0.0));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_NEAR(result.which[0].magnitude, kClockJitterS, 0.2 * kClockJitterS);
}

TEST(ClockJitter, IsNotWhatAWrongLawLeaves) {
  for (const auto& wrong :
       {effect(Effect::kCurrentDelay, 1.0e-4), effect(Effect::kInductanceSaturation, 0.01)}) {
    const RecordingSignals signals = record({.effects = {wrong}, .duration_s = 2.0});
    const auto result = diagnosed(signals, datasheet(0.0), {wrong.form.effect});
    for (const EffectResult& found : result.which)
      EXPECT_NE(found.effect, Effect::kClockJitter) << said(result);
  }
}

// An inductance that depends on the rotor's angle is in no catalogue, and what it leaves is nothing but
// noisier where the current changes: it passed for ripple of the supply, and "parameter_error" was the
// answer.
TEST(ClockJitter, IsNotWhatOneSensorAloneShows) {
  diagnose_test::DrivenSpindle spindle;
  spindle.rows = 20000;
  EXPECT_EQ(diagnosed(record(spindle), datasheet(0.1)).verdict, Verdict::kParameterError);
  spindle.inductance_at = [](double angle_rad) { return 1.0 + 0.3 * std::sin(2.0 * angle_rad); };
  const auto result = diagnosed(record(spindle), datasheet(0.1));
  EXPECT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
  EXPECT_TRUE(result.board_agrees);
}

// Beside a gear that meshes unevenly, which shows in the speed, too, such an inductance passed for a jitter
// at 97 %: the speed's own residuals follow its rate, all of them, or the current's do so by a quarter.
TEST(ClockJitter, IsNotWhatLawsOfTheAxisMakeOfBothSensors) {
  for (const double gear : {0.1, 0.01}) {
    diagnose_test::DrivenSpindle spindle;
    spindle.rows = 20000;
    spindle.inductance_at = [](double angle_rad) { return 1.0 + 0.03 * std::sin(2.0 * angle_rad); };
    spindle.brake_at = [gear](const diagnose_test::SpindleState& x, double) {
      return gear * std::sin(7.3 * x.angle_rad) * 0.065 * x.current_a;
    };
    const auto result = diagnosed(record(spindle), datasheet(0.1));
    EXPECT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
    for (const EffectResult& found : result.which)
      EXPECT_NE(found.effect, Effect::kClockJitter) << gear << ": " << said(result);
  }
}

TEST(ClockJitter, CanBeLeftOutOfTheCatalogue) {
  const auto result = diagnosed(record(shaken_clock()), datasheet(0.0), {Effect::kClockJitter});
  for (const EffectResult& found : result.which) EXPECT_NE(found.effect, Effect::kClockJitter);
}

// A random force that lasts some samples is no delay of the sensor that sees it.
TEST(RandomLoad, IsNoDelay) {
  for (const std::uint64_t seed : {3U, 5U}) {
    const auto result =
        diagnosed(record({.duration_s = 2.0, .seed = seed, .process_noise = 2.0}), datasheet(0.1));
    EXPECT_EQ(result.verdict, Verdict::kParameterError) << said(result);
  }
}

}  // namespace
}  // namespace morepro::host
