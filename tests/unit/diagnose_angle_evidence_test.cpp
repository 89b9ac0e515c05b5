// Voltage and current hardly tell whether a speed sensor or the supply is off; an angle that was recorded
// does.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "sim_host/diagnose/search/angle_evidence.hpp"
#include "tests/unit/driven_spindle.hpp"

namespace morepro::diagnose_test {
namespace {

/// Two seconds of a spindle whose angle and speed sensor show what they are told.
RecordingSignals turning(const std::function<double(double)>& angle_rad,
                         const std::function<double(double)>& speed_rad_s) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = 5000.0;
  signals.rows = 10000;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double time_s = signals.time_s(row);
    show(signals, Channel::kSpindleAngle, angle_rad(time_s));
    show(signals, Channel::kSpindleSpeed, speed_rad_s(time_s) + 0.2 * normal(random));
  }
  return signals;
}

double swinging_rad(double time_s) { return 40.0 * std::sin(3.0 * time_s); }
double swinging_rad_s(double time_s) { return 120.0 * std::cos(3.0 * time_s); }

TEST(BiasByAngle, IsToldFromScaleAndLag) {
  const auto signals = turning(swinging_rad, [](double t) { return 3.0 + 1.01 * swinging_rad_s(t - 0.002); });
  const auto told = host::bias_told_by_angle(signals, 0.0);
  ASSERT_TRUE(told);
  EXPECT_LT(told->standard_error_rad_s, 0.01);  // 0.2 rad/s in 10000 rows, and three columns
  EXPECT_NEAR(told->bias_rad_s, 3.0, 4.0 * told->standard_error_rad_s);
}

TEST(BiasByAngle, IsToldByAnAngleThatBeginsAnewWithEachTurn) {
  const auto wrapped = [](double t) { return std::remainder(swinging_rad(t), 2.0 * std::numbers::pi); };
  const auto told =
      host::bias_told_by_angle(turning(wrapped, [](double t) { return swinging_rad_s(t) - 2.0; }), 0.0);
  ASSERT_TRUE(told);
  EXPECT_LT(told->standard_error_rad_s, 0.02);
  EXPECT_NEAR(told->bias_rad_s, -2.0, 4.0 * told->standard_error_rad_s);
}

// Pieces of some hundred rows with hardly one that is whole.
TEST(BiasByAngle, IsToldBesideLostRows) {
  auto signals = turning(swinging_rad, [](double t) { return swinging_rad_s(t) + 3.0; });
  for (std::size_t row = 5; row < signals.rows; row += 50)
    signals.value[index_of(Channel::kSpindleSpeed)][row] = std::numeric_limits<float>::quiet_NaN();
  const auto told = host::bias_told_by_angle(signals, 0.0);
  ASSERT_TRUE(told);
  EXPECT_LT(told->standard_error_rad_s, 0.02);
  EXPECT_NEAR(told->bias_rad_s, 3.0, 4.0 * told->standard_error_rad_s);
}

TEST(BiasByAngle, IsNotToldFromAScaleAtOneSpeed) {
  const auto told = host::bias_told_by_angle(
      turning([](double t) { return 100.0 * t; }, [](double) { return 103.0; }), 0.0);
  EXPECT_TRUE(!told || told->standard_error_rad_s > 1.0) << told->standard_error_rad_s;
  RecordingSignals without = turning(swinging_rad, swinging_rad_s);
  leave_out(without, Channel::kSpindleAngle);
  EXPECT_FALSE(host::bias_told_by_angle(without, 0.0));
}

void offset(RecordingSignals& signals, Channel channel, double by) {
  for (float& value : signals.value[index_of(channel)]) value += static_cast<float>(by);
}

MachineDescription spindle_alone() {
  MachineDescription machine = datasheet(0.05);
  machine.has_feed = false;
  return machine;
}

DiagnosisResult diagnosed_beside(Channel channel, double by) {
  RecordingSignals signals = record(DrivenSpindle{.shows_angle = true});
  offset(signals, channel, by);
  return diagnosed(std::move(signals), spindle_alone());
}

void expect_alone(const DiagnosisResult& result, Effect effect, double size) {
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().alias_set, std::vector{effect}) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, size, 4.0 * result.which.front().standard_error);
}

// It was an offset of the supply, at 88 %, which the angle contradicts by 27 rad.
TEST(AngleEvidence, TellsASensorFromASupply) {
  expect_alone(diagnosed_beside(Channel::kSpindleSpeed, 3.0), Effect::kSpindleSpeedBias, 3.0);
  expect_alone(diagnosed_beside(Channel::kArmatureVoltage, 0.5), Effect::kSupplyVoltageOffset, -0.5);
}

// The angle tells all of a bias; what is known of it speaks for no more.
TEST(AngleEvidence, IsBeyondWhatTheMachineFileStates) {
  RecordingSignals signals = record(DrivenSpindle{.shows_angle = true});
  offset(signals, Channel::kSpindleSpeed, 3.0);
  offset(signals, Channel::kArmatureVoltage, -0.24);  // as much as 3 rad/s more would look like
  MachineDescription machine = spindle_alone();
  machine.effects.push_back(effect(Effect::kSpindleSpeedBias, 3.0));
  expect_alone(diagnosed(std::move(signals), machine), Effect::kSupplyVoltageOffset, 0.24);
}

}  // namespace
}  // namespace morepro::diagnose_test
