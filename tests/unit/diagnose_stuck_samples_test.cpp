// Sensors that hang for long: a fit would follow them, and give them a name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim_host/diagnose/signals/stuck_samples.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

constexpr SimulatedRun kMoving{.duration_s = 2.0, .rate_hz = 5000.0};

std::vector<float>& column_of(RecordingSignals& signals, Channel channel) {
  return signals.value[index_of(channel)];
}

/// One value from `first` on, for `rows`.
void hold(RecordingSignals& signals, Channel channel, std::size_t first, std::size_t rows) {
  auto& column = column_of(signals, channel);
  for (std::size_t row = first + 1; row <= first + rows; ++row) column[row] = column[first];
}

std::vector<host::StuckSensor> left_out_of(RecordingSignals& signals) {
  host::leave_out_stuck_samples(signals, reference_configuration().sensors);
  return signals.stuck;
}

TEST(StuckSamples, AreLeftOutOfAnySensor) {
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition}) {
    RecordingSignals signals = record(kMoving);
    hold(signals, channel, 3000, 400);
    hold(signals, channel, 8000, 300);
    const auto stuck = left_out_of(signals);
    ASSERT_EQ(stuck.size(), 1U) << kChannels[index_of(channel)].column;
    EXPECT_EQ(stuck.front().channel, channel);
    EXPECT_EQ(stuck.front().times, 2U);
    EXPECT_EQ(stuck.front().rows, 700U);
    EXPECT_EQ(stuck.front().first_row, 3001U);
    const auto& column = column_of(signals, channel);
    EXPECT_EQ(std::ranges::count_if(column, [](float value) { return std::isnan(value); }), 700);
    EXPECT_FALSE(std::isnan(column[3000])) << "the sample that is repeated is one";
  }
}

TEST(StuckSamples, AreNoneOfAMachineThatIsWatchedWell) {
  for (const auto profile :
       {host::ProfileKind::kRich, host::ProfileKind::kProduction, host::ProfileKind::kCommissioning}) {
    SimulatedRun run = kMoving;
    run.profile = profile;
    RecordingSignals signals = record(run);
    EXPECT_TRUE(left_out_of(signals).empty());
  }
}

// The sensor of a drive that shows 0 below some speed, while the axis creeps, and is precise.
TEST(StuckSamples, AreNotARestThatIsShownAsOne) {
  RecordingSignals signals = record(kMoving);
  auto& speed = column_of(signals, Channel::kFeedSpeed);
  auto& place = column_of(signals, Channel::kFeedPosition);
  for (std::size_t row = 3000; row < 3400; ++row) {
    speed[row] = 0.0F;
    place[row] = place[3000] + 1.0e-7F * static_cast<float>(row - 3000);
  }
  speed[3400] = 10.0F * static_cast<float>(reference_configuration().sensors[Channel::kFeedSpeed].noise);
  EXPECT_TRUE(left_out_of(signals).empty());
}

// A link that brings a value every 8 ms into a recording of 5 kHz.
TEST(StuckSamples, AreNotThoseOfASlowLink) {
  RecordingSignals signals = record(kMoving);
  auto& speed = column_of(signals, Channel::kSpindleSpeed);
  for (std::size_t row = 0; row < signals.rows; ++row) speed[row] = speed[row - row % 40];
  EXPECT_TRUE(left_out_of(signals).empty());
}

// At an even speed the numbers of a simulation are the same to the last bit, though a machine file says
// noise.
TEST(StuckSamples, AreNotThoseOfASensorWithoutNoise) {
  RecordingSignals signals = record(kMoving);
  auto& speed = column_of(signals, Channel::kFeedSpeed);
  auto& place = column_of(signals, Channel::kFeedPosition);
  for (std::size_t row = 3000; row < 3800; ++row) {
    const float before = static_cast<float>(3800 - row) / 800.0F;
    speed[row] = 0.05F + (row < 3400 ? 1.0e-6F * before : 0.0F);
    place[row] = place[row - 1] + 1.0e-5F;
  }
  EXPECT_TRUE(left_out_of(signals).empty());
  Sensors sensors = reference_configuration().sensors;
  sensors[Channel::kFeedSpeed].noise = 1.0e-12;  // as files of simulated machines state it
  host::leave_out_stuck_samples(signals, sensors);
  EXPECT_TRUE(signals.stuck.empty());
}

TEST(StuckSamples, AreAPositionAtAnEvenSpeedToo) {
  RecordingSignals signals = record(kMoving);
  for (std::size_t row = 3000; row < signals.rows; ++row)
    column_of(signals, Channel::kFeedSpeed)[row] = 0.2F + (row % 2 == 0 ? 0.001F : -0.001F);
  hold(signals, Channel::kFeedPosition, signals.rows - 400, 399);  // to the end
  EXPECT_EQ(left_out_of(signals).size(), 1U);
}

// What drives the spindle there, and may be at its limit.
TEST(StuckSamples, AreNotACurrentThatStandsForTheVoltage) {
  RecordingSignals signals = record(kMoving);
  hold(signals, Channel::kArmatureCurrent, 3000, 400);
  signals.is_current_driven = true;
  EXPECT_TRUE(left_out_of(signals).empty());
}

TEST(StuckSamples, AreNotThoseOfASensorInSteps) {
  for (const float step : {20.0F, 100.0F}) {
    RecordingSignals signals = record(kMoving);
    for (float& speed : column_of(signals, Channel::kSpindleSpeed)) speed = step * std::round(speed / step);
    EXPECT_TRUE(left_out_of(signals).empty()) << step;
  }
}

// It may show one value for as long as it likes.
TEST(StuckSamples, AreNotThoseOfASensorWhoseStepsAreStated) {
  RecordingSignals signals = record(kMoving);
  hold(signals, Channel::kSpindleSpeed, 3000, 400);
  Sensors sensors = reference_configuration().sensors;
  sensors[Channel::kSpindleSpeed].lsb = 2.5 * sensors[Channel::kSpindleSpeed].noise;
  host::leave_out_stuck_samples(signals, sensors);
  EXPECT_TRUE(signals.stuck.empty());
}

TEST(StuckSamples, AreNotWhereNothingElseMoves) {
  RecordingSignals signals = record(kMoving);
  for (const Channel channel : {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kArmatureVoltage})
    hold(signals, channel, 3000, 400);
  EXPECT_TRUE(left_out_of(signals).empty());
}

TEST(StuckSamples, AreNoHealthAndNoBias) {
  RecordingSignals signals = record(kMoving);
  hold(signals, Channel::kSpindleSpeed, 6000, signals.rows - 6001);
  const DiagnosisResult result = diagnosed(std::move(signals), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
  ASSERT_EQ(result.unexplained_follows.size(), 1U);
  EXPECT_NE(result.unexplained_follows.front().signal.find("it repeats its last sample there"),
            std::string::npos);
  EXPECT_TRUE(std::ranges::any_of(result.notices, [](const std::string& notice) {
    return notice.starts_with("spindle_speed_rad_s hangs");
  }));
}

TEST(StuckSamples, DoNotHideAnEffect) {
  SimulatedRun run = kMoving;
  run.effects = {effect(Effect::kSpindleCoulombFriction, 0.05)};
  RecordingSignals signals = record(run);
  hold(signals, Channel::kSpindleSpeed, 6000, 500);
  const DiagnosisResult result = diagnosed(std::move(signals), datasheet(0.0));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kSpindleCoulombFriction);
  EXPECT_NEAR(result.which.front().magnitude, 0.05, 0.0025);  // a twentieth: what such a fit is known to
}

}  // namespace
}  // namespace morepro::diagnose_test
