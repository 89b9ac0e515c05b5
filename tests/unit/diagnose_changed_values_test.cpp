// A machine that is another one from a time on: a payload was taken, a connector has come loose. No effect of
// the catalogue does that, and several come near.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "tests/unit/driven_axis.hpp"
#include "tests/unit/driven_spindle.hpp"

namespace morepro::diagnose_test {
namespace {

/// "unexplained", by nothing but values that have changed.
void expect_changed(const DiagnosisResult& result, gap::Balance balance, const std::string& words) {
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
  ASSERT_EQ(result.unexplained_follows.size(), 1U) << said(result);
  EXPECT_EQ(result.unexplained_follows.front().balance, balance);
  EXPECT_NE(result.unexplained_follows.front().signal.find(words), std::string::npos)
      << result.unexplained_follows.front().signal;
}

// It was a force that saturates, at 86 to 90 %.
TEST(ChangedValues, AreAPayload) {
  const DrivenAxis axis{.mass_over_time = [](double time_s) { return time_s < 3.1 ? 1.0 : 1.4; }};
  const auto result = diagnosed(record(axis), datasheet(0.1));
  expect_changed(result, gap::Balance::kFeedForce, "from about 3.1 s on: mass_kg is 1.4 times as large");
}

TEST(ChangedValues, AreAPayloadThatThePositionAloneTells) {
  const DrivenAxis axis{.has_speed = false,
                        .mass_over_time = [](double time_s) { return time_s < 3.1 ? 1.0 : 1.4; }};
  const auto result = diagnosed(record(axis), datasheet(0.1));
  expect_changed(result, gap::Balance::kFeedForce, "from about 3.1 s on: mass_kg is 1.4 times as large");
}

// In production process noise may take it all: then nothing has a name, nothing is left without one, and the
// answer was "parameter_error", with a mass between the two, of four of four such axes of another simulator.
TEST(ChangedValues, AreLookedForWhereNothingElseWasFound) {
  const RecordingSignals signals =
      record(DrivenAxis{.mass_over_time = [](double time_s) { return time_s < 3.1 ? 1.0 : 1.4; }});
  const host::GapModel model = gap_model(datasheet(0.1), signals);
  const host::AxisFit nominal = host::nominal_fits(host::AxisFit(host::Axis::kFeed, signals, model)).front();
  std::array outcomes{host::AxisOutcome{.diagnosis = {.fit = nominal, .nominal = nominal}}};
  host::conclude(outcomes);
  ASSERT_TRUE(host::has_changed(outcomes.front()));
  EXPECT_NE(outcomes.front().leftover.changed_values.find("mass_kg is 1.4 times as large"),
            std::string::npos);
}

// It was a winding that warms, at 98 %.
TEST(ChangedValues, AreALooseConnector) {
  MachineDescription machine = datasheet(0.05);
  machine.has_feed = false;
  const DrivenSpindle spindle{.resistance_at = [](double time_s) { return time_s < 1.8 ? 1.0 : 1.5; }};
  const auto result = diagnosed(record(spindle), machine);
  expect_changed(result, gap::Balance::kArmatureVoltage,
                 "from about 1.8 s on: resistance_ohm is 1.5 times as large");
}

// It was a motor that saturates, at 95 %: in the air no torque is told, but how they go together is.
TEST(ChangedValues, AreAnotherToolInTheAir) {
  MachineDescription machine = datasheet(0.05);
  machine.has_feed = false;
  const DrivenSpindle spindle{.inertia_at = [](double time_s) { return time_s < 1.8 ? 1.0 : 1.4; },
                              .cuts = false};
  const auto result = diagnosed(record(spindle), machine);
  expect_changed(result, gap::Balance::kSpindleTorque,
                 "from about 1.8 s on: inertia_kgm2 is 1.4 times as large for one torque constant");
}

constexpr double kTurnS = 3.5;

/// Forwards until some time, and backwards from then on.
double there_and_back_m(double time_s) {
  return 0.04 * std::min(time_s, 2.0 * kTurnS - time_s) + 2.0e-4 * std::sin(83.0 * time_s);
}

// What depends on the direction is two machines there, and has names. It was "unexplained".
TEST(ChangedValues, AreNotTheOtherDirection) {
  const DrivenAxis axis{
      .brake_at = [](double v) { return (v > 0.0 ? 1.0 : -0.6) * 70.0 * std::pow(std::fabs(v), 0.9); },
      .wanted_m = there_and_back_m};
  const auto result = diagnosed(record(axis), datasheet(0.1));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  for (const auto& followed : result.unexplained_follows)
    EXPECT_EQ(followed.signal.find("others from"), std::string::npos) << followed.signal;
}

// Out empty and back loaded: no mass depends on the direction.
TEST(ChangedValues, AreAPayloadThatIsBroughtBack) {
  const DrivenAxis axis{.mass_over_time = [](double time_s) { return time_s < kTurnS ? 1.0 : 1.4; },
                        .wanted_m = there_and_back_m};
  const auto result = diagnosed(record(axis), datasheet(0.1));
  expect_changed(result, gap::Balance::kFeedForce, "from about 3.5 s on: mass_kg is 1.4 times as large");
}

// Two machines have more values than one effect: what sets in late keeps its name.
TEST(ChangedValues, AreNoEffectThatSetsInLate) {
  for (const auto& late :
       {effect(Effect::kFeedViscousFriction, 100.0, 1.25), effect(Effect::kFeedForceOffset, 6.0, 1.25),
        effect(Effect::kSpindleCoulombFriction, 0.01, 1.25)}) {
    const auto result = diagnosed(record({.effects = {late}}), datasheet(0.1));
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_TRUE(names(result.which.front(), late.form.effect)) << said(result);
    for (const auto& followed : result.unexplained_follows)
      EXPECT_EQ(followed.signal.find("others from"), std::string::npos) << followed.signal;
  }
}

}  // namespace
}  // namespace morepro::diagnose_test
