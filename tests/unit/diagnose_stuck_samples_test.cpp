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
    hold(signals, channel, 6000, 300);
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

// The sensor of a drive that shows 0 below some speed, while the axis creeps.
TEST(StuckSamples, AreNotARestThatIsShownAsOne) {
  RecordingSignals signals = record(kMoving);
  hold(signals, Channel::kFeedSpeed, 3000, 0);
  auto& speed = column_of(signals, Channel::kFeedSpeed);
  auto& place = column_of(signals, Channel::kFeedPosition);
  for (std::size_t row = 3000; row < 3400; ++row) {
    speed[row] = 0.0F;
    place[row] = place[3000] + 1.0e-7F * static_cast<float>(row - 3000);
  }
  speed[3400] = 0.001F;
  EXPECT_TRUE(left_out_of(signals).empty());
}

TEST(StuckSamples, AreNotThoseOfASensorInSteps) {
  RecordingSignals signals = record(kMoving);
  for (float& speed : column_of(signals, Channel::kSpindleSpeed)) speed = 20.0F * std::round(speed / 20.0F);
  EXPECT_TRUE(left_out_of(signals).empty());
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
