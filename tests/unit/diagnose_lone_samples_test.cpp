#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim_host/diagnose/signals/lone_samples.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::SimulatedRun;
using gap::Effect;

std::vector<float>& column_of(RecordingSignals& signals, Channel channel) {
  return signals.value[index_of(channel)];
}

TEST(LoneSamples, AreLeftOut) {
  RecordingSignals signals = record({.effects = {}, .duration_s = 1.0});
  const Sensors sensors = reference_sensors();
  const double noise = std::sqrt(sensors[Channel::kSpindleSpeed].variance());
  const std::vector<float> before = column_of(signals, Channel::kSpindleSpeed);
  for (const std::size_t row : {7000U, 8000U})
    column_of(signals, Channel::kSpindleSpeed)[row] += static_cast<float>(40.0 * noise);
  const auto found = leave_out_lone_samples(signals, sensors);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, Channel::kSpindleSpeed);
  EXPECT_EQ(found[0].count, 2U);
  EXPECT_EQ(found[0].first_row, 7000U);
  EXPECT_NEAR(found[0].farthest, 40.0, 6.0);  // and what noise adds
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const float value = column_of(signals, Channel::kSpindleSpeed)[row];
    const bool is_lone = row == 7000 || row == 8000;
    EXPECT_TRUE(is_lone ? std::isnan(value) : value == before[row]) << row;
  }
}

TEST(LoneSamples, AreNoneInARecordingThatTurnsAndCuts) {
  RecordingSignals signals = record(
      {.effects = {effect(Effect::kSpindleCoulombFriction, 0.03), effect(Effect::kSpindleCogging, 0.05),
                   effect(Effect::kToothPassingTorque, 0.3), effect(Effect::kFeedCoulombFriction, 5.0)},
       .duration_s = 4.0});
  EXPECT_TRUE(leave_out_lone_samples(signals, reference_sensors()).empty());
}

// A tool that hits something once, a voltage that is switched: the samples after it know of it.
TEST(LoneSamples, AreNoStepsAndNoKinks) {
  RecordingSignals signals = record({.effects = {}, .duration_s = 1.0});
  auto& speed = column_of(signals, Channel::kSpindleSpeed);
  for (std::size_t row = 3000; row < speed.size(); ++row) speed[row] += 100.0F;
  for (std::size_t row = 6000; row < speed.size(); ++row)
    speed[row] += 20.0F * static_cast<float>(row - 5999);
  EXPECT_TRUE(leave_out_lone_samples(signals, reference_sensors()).empty());
}

// A voltage of one sample drives a current of one or two.
TEST(LoneSamples, AreNotWhatAnInputDrives) {
  RecordingSignals signals = record({.effects = {}, .duration_s = 1.0});
  for (std::size_t row = 5000; row < 5100; ++row) {
    column_of(signals, Channel::kArmatureVoltage)[row] = 20.0F;
    column_of(signals, Channel::kArmatureCurrent)[row] = 1.0F;
  }
  column_of(signals, Channel::kArmatureCurrent)[5050] += 10.0F;
  RecordingSignals driven = signals;
  column_of(driven, Channel::kArmatureVoltage)[5049] += 8.0F;
  EXPECT_EQ(leave_out_lone_samples(signals, reference_sensors()).size(), 1U);
  EXPECT_TRUE(leave_out_lone_samples(driven, reference_sensors()).empty());
}

// What shakes a speed for a moment makes some samples that look alone, by chance.
TEST(LoneSamples, AreNoneAmongManyThatMove) {
  RecordingSignals signals = record({.effects = {}, .duration_s = 1.0});
  std::mt19937_64 random(1);
  std::normal_distribution<float> shake(0.0F, 40.0F);
  for (std::size_t row = 4000; row < 4400; ++row)
    column_of(signals, Channel::kSpindleSpeed)[row] += shake(random);
  EXPECT_TRUE(leave_out_lone_samples(signals, reference_sensors()).empty());
}

// What happens a hundred times a second is the machine's.
TEST(LoneSamples, AreFew) {
  RecordingSignals signals = record({.effects = {}, .duration_s = 1.0});
  for (std::size_t row = 50; row < signals.rows; row += 100)
    column_of(signals, Channel::kSpindleSpeed)[row] += 100.0F;
  EXPECT_TRUE(leave_out_lone_samples(signals, reference_sensors()).empty());
}

}  // namespace
}  // namespace morepro::host
