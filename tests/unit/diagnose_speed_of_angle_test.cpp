// A spindle of which the angle alone is recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "sim_host/diagnose/signals/speed_of_angle.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// A spindle that turns at 100 +- 50 rad/s, whose angle is known to `noise_rad`: within a turn, or all of
/// them.
RecordingSignals known_by_angle(bool is_within_turn, double noise_rad = 0.0, double times = 1.0) {
  RecordingSignals signals;
  signals.rate_hz = 10000.0;
  signals.rows = 20000;
  signals.recorded = bit_of(Channel::kSpindleAngle);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double turned = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double shown = turned + noise_rad * normal(random);
    signals.value[index_of(Channel::kSpindleAngle)].push_back(
        static_cast<float>(is_within_turn ? std::remainder(shown, 2.0 * std::numbers::pi) : shown));
    turned += times * (0.01 + 0.005 * std::sin(1.0e-3 * static_cast<double>(row)));
  }
  return signals;
}

double noise_of(RecordingSignals signals, SensorNoise angle) {
  Sensors sensors = reference_sensors();
  sensors[Channel::kSpindleAngle] = angle;
  EXPECT_TRUE(host::take_speed_from_angle(signals, sensors));
  return sensors[Channel::kSpindleSpeed].noise;
}

TEST(SpeedOfAngle, IsThatOfTheRow) {
  for (const bool is_within_turn : {false, true}) {
    RecordingSignals signals = known_by_angle(is_within_turn);
    Sensors sensors = reference_sensors();
    ASSERT_TRUE(host::take_speed_from_angle(signals, sensors));
    EXPECT_TRUE(signals.has(Channel::kSpindleSpeed) && signals.has_speed_of_angle);
    const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
    EXPECT_TRUE(std::isnan(speed.front()) && std::isnan(speed.back()));
    // Between the increments before and after; a float of 200 rad is known to 8e-6 rad.
    for (std::size_t row = 1; row + 1 < signals.rows; ++row)
      ASSERT_NEAR(speed[row], 100.0 + 50.0 * std::sin(1.0e-3 * (static_cast<double>(row) - 0.5)), 0.12)
          << row;
    EXPECT_FALSE(host::take_speed_from_angle(signals, sensors)) << "it has one now";
  }
}

// Of 1e-4 rad, over two rows of 0.1 ms.
TEST(SpeedOfAngle, IsKnownAsItsAngleIs) {
  constexpr double kExpected = 10000.0 * 1.0e-4 / std::numbers::sqrt2;
  EXPECT_NEAR(noise_of(known_by_angle(false, 1.0e-4), {.noise = 1.0e-4, .lsb = 0.0}), kExpected,
              0.02 * kExpected);
  EXPECT_NEAR(noise_of(known_by_angle(false, 1.0e-4), {}), kExpected, 0.1 * kExpected)
      << "as it shows, where nothing is stated";
}

// Its first and its last row have no speed, and nothing is lost; a row that is shown once more is, and takes
// the speeds beside it along.
TEST(SpeedOfAngle, LosesRowsAsItsAngleDoes) {
  const auto short_one = [] {
    RecordingSignals signals = known_by_angle(false, 1.0e-4);
    signals.rows = 3000;
    signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kArmatureCurrent));
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    signals.value[index_of(Channel::kSpindleAngle)].resize(signals.rows);
    for (std::size_t row = 0; row < signals.rows; ++row)
      signals.value[index_of(Channel::kArmatureCurrent)].push_back(normal(random));
    return signals;
  };
  Sensors sensors = reference_sensors();
  RecordingSignals sound = short_one();
  ASSERT_TRUE(host::take_speed_from_angle(sound, sensors));
  EXPECT_FALSE(host::find_dropout(sound).has_value());
  RecordingSignals losing = short_one();
  for (const Channel channel : {Channel::kSpindleAngle, Channel::kArmatureCurrent})
    for (std::size_t row = 50; row < losing.rows; row += 50)
      losing.value[index_of(channel)][row] = losing.value[index_of(channel)][row - 1];
  ASSERT_TRUE(host::take_speed_from_angle(losing, sensors));
  const auto fault = host::find_dropout(losing);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NEAR(fault->size, 0.02, 0.001);
  const auto& speed = losing.value[index_of(Channel::kSpindleSpeed)];
  EXPECT_TRUE(std::isnan(speed[99]) && std::isnan(speed[100]) && std::isnan(speed[101]));
  EXPECT_FALSE(std::isnan(speed[98]) || std::isnan(speed[102]));
}

TEST(SpeedOfAngle, IsNoneOfAnAngleThatDoesNotTurnOrTooFast) {
  Sensors sensors = reference_sensors();
  RecordingSignals still = known_by_angle(false, 0.0, 0.0);
  EXPECT_FALSE(host::take_speed_from_angle(still, sensors));
  EXPECT_FALSE(still.has(Channel::kSpindleSpeed));
  RecordingSignals fast = known_by_angle(true, 0.0, 250.0);
  EXPECT_FALSE(host::take_speed_from_angle(fast, sensors)) << "by 0.6 of a turn from row to row";
  RecordingSignals sparse = known_by_angle(false);
  auto& angle = sparse.value[index_of(Channel::kSpindleAngle)];
  for (std::size_t row = 0; row < angle.size(); row += 3)
    angle[row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(host::take_speed_from_angle(sparse, sensors));
}

}  // namespace
}  // namespace morepro::diagnose_test
