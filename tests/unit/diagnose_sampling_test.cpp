#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::SimulatedRun;
using gap::Effect;

SimulatedRun short_run(std::vector<gap::AppliedEffect> effects) {
  return {.effects = std::move(effects), .duration_s = 1.0};
}

/// Two sensors that stand still in noise of ten of their steps: one row in 1250 repeats the one before.
RecordingSignals two_stepped_sensors(std::size_t rows) {
  RecordingSignals signals;
  signals.rate_hz = 10000.0;
  signals.rows = rows;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 10.0);
  for (const Channel channel : {Channel::kSpindleSpeed, Channel::kArmatureCurrent}) {
    signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(channel));
    auto& column = signals.value[index_of(channel)];
    for (std::size_t row = 0; row < rows; ++row)
      column.push_back(static_cast<float>(std::round(noise(random))));
  }
  return signals;
}

TEST(SamplingChecks, FindNothingInAHealthyRecording) {
  RecordingSignals signals = record(short_run({}));
  Sensors sensors = reference_sensors();
  EXPECT_TRUE(find_quantization(signals, sensors).empty());
  EXPECT_FALSE(find_dropout(signals).has_value());
}

TEST(SamplingChecks, FindTheStepOfEveryCoarseSensor) {
  RecordingSignals signals = record(short_run({effect(Effect::kSensorQuantization, 4.0)}));
  Sensors sensors = reference_sensors();
  const auto faults = find_quantization(signals, sensors);
  ASSERT_EQ(faults.size(), 3U);
  for (const SamplingFault& fault : faults) {
    EXPECT_NEAR(fault.size, 4.0, 0.01);
    EXPECT_NEAR(sensors[fault.channel].lsb, 4.0 * sensors[fault.channel].noise,
                0.01 * sensors[fault.channel].lsb);
  }
}

TEST(SamplingChecks, TakeAStepForGrantedThatTheMachineFileStates) {
  MonitorConfiguration configuration = reference_configuration();
  configuration.sensors[Channel::kSpindleSpeed].lsb = 4.0;
  SimulatedRun run = short_run({});
  run.configuration = configuration;
  RecordingSignals signals = record(run);
  EXPECT_TRUE(find_quantization(signals, configuration.sensors).empty());
  Sensors without = reference_sensors();
  ASSERT_EQ(find_quantization(signals, without).size(), 1U);
  EXPECT_NEAR(without[Channel::kSpindleSpeed].lsb, 4.0, 1.0e-3);
}

// The reference machine's noise stands in where a file says nothing: 0.05 A, of which steps of 0.07 A
// were 1.4 `lsb` at 0.97, of a right motor of 50 A.
TEST(SamplingChecks, TakeAStepForTheSensorsOwnWhereTheMachineFileSaysNothing) {
  constexpr auto kCurrent = bit_of(Channel::kArmatureCurrent);
  const auto faults_of = [](double noise_steps, std::uint16_t assumed, double& lsb) {
    RecordingSignals signals = two_stepped_sensors(4000);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, noise_steps);
    auto& current = signals.value[index_of(Channel::kArmatureCurrent)];
    for (std::size_t row = 0; row < current.size(); ++row)
      current[row] = static_cast<float>(
          0.07 * std::round(20.0 * std::sin(0.001 * static_cast<double>(row)) + noise(random)));
    Sensors sensors = reference_sensors();
    const std::size_t faults = find_quantization(signals, sensors, assumed).size();
    lsb = sensors[Channel::kArmatureCurrent].lsb;
    return faults;
  };
  double lsb = 0.0;
  EXPECT_EQ(faults_of(1.0, 0, lsb), 1U) << "the file says how fine it is";
  EXPECT_EQ(faults_of(1.0, kCurrent, lsb), 0U);
  EXPECT_NEAR(lsb, 0.07, 1.0e-6) << "known all the same";
  EXPECT_EQ(faults_of(0.1, kCurrent, lsb), 1U) << "nothing of its noise is to be seen";
}

TEST(SamplingChecks, CountTheRowsThatAreMissing) {
  RecordingSignals signals = record(short_run({effect(Effect::kSampleDropout, 0.1)}));
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->effect, Effect::kSampleDropout);
  EXPECT_NEAR(fault->size, static_cast<double>(signals.missing_rows) / static_cast<double>(signals.rows),
              1.0e-9);
}

TEST(SamplingChecks, SeeWhenStepsSetIn) {
  constexpr double kOnsetS = 0.6;
  RecordingSignals signals = record(short_run({effect(Effect::kSensorQuantization, 20.0, kOnsetS)}));
  Sensors sensors = reference_sensors();
  const auto faults = find_quantization(signals, sensors);
  ASSERT_FALSE(faults.empty());
  for (const SamplingFault& fault : faults) {
    EXPECT_NEAR(fault.size, 20.0, 0.1);
    // A sample or two before may lie on a step by chance.
    EXPECT_NEAR(fault.onset_s, kOnsetS, 5.0e-4);
  }
}

TEST(SamplingChecks, SeeWhenRowsBeginToBeLost) {
  constexpr double kOnsetS = 0.5;
  RecordingSignals signals = record(short_run({effect(Effect::kSampleDropout, 0.1, kOnsetS)}));
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NEAR(fault->size, 0.1, 3.0 * fault->standard_error);
  // One of ten rows is lost.
  EXPECT_NEAR(fault->onset_s, kOnsetS, 0.005);
  RecordingSignals all_along = record(short_run({effect(Effect::kSampleDropout, 0.1)}));
  EXPECT_EQ(find_dropout(all_along)->onset_s, 0.0);
}

// A frame that is sent again says nothing of its own row, not even what drove the machine.
TEST(SamplingChecks, TakeARepeatedFrameForAMissingOne) {
  RecordingSignals signals = record(short_run({}));
  for (std::size_t row = 50; row < signals.rows; row += 50)
    for (auto& column : signals.value)
      if (!column.empty()) column[row] = column[row - 1];
  for (const Channel channel :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kFeedPosition})
    signals.value[index_of(channel)][25] = signals.value[index_of(channel)][24];
  signals.value[index_of(Channel::kArmatureVoltage)][25] += 1.0F;
  ASSERT_TRUE(find_dropout(signals).has_value());
  EXPECT_TRUE(is_missing(signals, 50));
  EXPECT_FALSE(is_missing(signals, 25)) << "its input is known";
  EXPECT_EQ(signals.missing_rows, (signals.rows - 1) / 50);
}

// A link that was away for 0.1 s lost as many samples as one that drops one in a hundred.
TEST(SamplingChecks, TakeNoLongHoleForLostSamples) {
  RecordingSignals signals = record(short_run({}));
  for (auto& column : signals.value)
    for (std::size_t row = 5000; !column.empty() && row < 6000; ++row)
      column[row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(find_dropout(signals).has_value());
  for (auto& column : signals.value)
    for (std::size_t row = 0; !column.empty() && row < 5000; row += 50)
      column[row] = std::numeric_limits<float>::quiet_NaN();
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NEAR(fault->size, 100.0 / static_cast<double>(signals.rows), 1.0e-9);
}

TEST(SamplingChecks, KnowThatLostSamplesLeaveLittleStructure) {
  const auto lost = [](double share) {
    return std::vector{SamplingFault{.effect = Effect::kSampleDropout, .size = share}};
  };
  EXPECT_EQ(structure_left_by({}), 0.0);
  EXPECT_LT(structure_left_by(lost(0.05)), 0.01);
  EXPECT_GT(structure_left_by(lost(0.05)), structure_left_by(lost(0.002)));
  EXPECT_TRUE(
      std::isinf(structure_left_by({SamplingFault{.effect = Effect::kSensorQuantization, .size = 20.0}})));
}

TEST(SamplingChecks, TakeRepeatedRowsOutOfTheRecording) {
  RecordingSignals signals = record(short_run({}));
  for (std::size_t row = 50; row < signals.rows; row += 50)
    for (auto& column : signals.value)
      if (!column.empty()) column[row] = column[row - 1];
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NEAR(fault->size, 1.0 / 50.0, 0.001);
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  EXPECT_TRUE(std::isnan(speed[50]) && std::isnan(speed[9950]));
  EXPECT_FALSE(std::isnan(speed[49]) || std::isnan(speed[51]));
}

TEST(SamplingChecks, DoNotTakeOneSensorThatStandsStillForALostRow) {
  RecordingSignals signals = record(short_run({}));
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  std::fill(speed.begin() + 2000, speed.begin() + 4000, speed[2000]);
  EXPECT_FALSE(find_dropout(signals).has_value());
}

TEST(SamplingChecks, TakeNoRowForLostThatChanceMakesEqual) {
  RecordingSignals signals = two_stepped_sensors(80000);
  EXPECT_FALSE(find_dropout(signals).has_value());
  for (const float value : signals.value[index_of(Channel::kSpindleSpeed)]) ASSERT_FALSE(std::isnan(value));
}

TEST(SamplingChecks, TellLostRowsFromThoseThatChanceMakesEqual) {
  constexpr std::size_t kLostEvery = 100;
  RecordingSignals signals = two_stepped_sensors(80000);
  for (std::size_t row = kLostEvery; row < signals.rows; row += kLostEvery)
    for (auto& column : signals.value)
      if (!column.empty()) column[row] = column[row - 1];
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  // Chance makes 0.0008, known to a fifth.
  EXPECT_NEAR(fault->size, 1.0 / kLostEvery, 4.0e-4);
}

/// A fine sensor and a coarse one, whose steps are 1.75 of its noise: it is the same in two of five rows.
RecordingSignals fine_and_coarse() {
  RecordingSignals signals = two_stepped_sensors(20000);
  for (float& value : signals.value[index_of(Channel::kArmatureCurrent)])
    value = 17.5F * std::round(value / 17.5F);
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  for (std::size_t row = 0; row < speed.size(); ++row) speed[row] += 0.3F * std::sin(static_cast<float>(row));
  return signals;
}

void repeat_every_100th(std::vector<float>& column) {
  for (std::size_t row = 100; row < column.size(); row += 100) column[row] = column[row - 1];
}

TEST(SamplingChecks, TakeARowForLostWhereACoarseSensorVouchesForTheOnlyFineOne) {
  RecordingSignals signals = fine_and_coarse();
  repeat_every_100th(signals.value[index_of(Channel::kSpindleSpeed)]);
  repeat_every_100th(signals.value[index_of(Channel::kArmatureCurrent)]);
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NEAR(fault->size, 0.01, 1.0e-3);
}

TEST(SamplingChecks, TakeNoRowForLostWhereTheOnlyFineSensorStandsStill) {
  RecordingSignals signals = fine_and_coarse();
  repeat_every_100th(signals.value[index_of(Channel::kSpindleSpeed)]);
  EXPECT_FALSE(find_dropout(signals).has_value());
}

TEST(SamplingChecks, TakeNoRowForLostInWhichACoarseSensorChanges) {
  constexpr std::size_t kSameEvery = 100;
  RecordingSignals signals = two_stepped_sensors(80000);
  for (std::size_t row = kSameEvery; row < signals.rows; row += kSameEvery)
    for (auto& column : signals.value)
      if (!column.empty()) column[row] = column[row - 1];
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kFeedSpeed));
  for (std::size_t row = 0; row < signals.rows; ++row)
    signals.value[index_of(Channel::kFeedSpeed)].push_back(static_cast<float>(row));
  EXPECT_FALSE(find_dropout(signals).has_value());
}

/// A spindle whose sensors have steps as large as their noise, of which no machine file says anything, while
/// speed and current swing: 7 and 4 of 100 samples are the same as the one before. `is_lost(row)`: shown once
/// more.
template <class IsLost>
RecordingSignals two_coarse_sensors(IsLost is_lost) {
  RecordingSignals signals = two_stepped_sensors(24000);
  std::mt19937 random(7);
  std::normal_distribution<float> noise;
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  auto& current = signals.value[index_of(Channel::kArmatureCurrent)];
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const auto phase = 0.05F * static_cast<float>(row);
    speed[row] = is_lost(row) ? speed[row - 1] : std::round(100.0F * std::sin(phase) + noise(random));
    current[row] =
        is_lost(row) ? current[row - 1] : std::round(200.0F * std::sin(1.3F * phase) + noise(random));
  }
  return signals;
}

// One row in two hundred repeats itself by chance: a `sample_dropout` of 0.5 % before, at 0.97, four times of
// 108 recordings of another simulator.
TEST(SamplingChecks, TakeNoRowForLostThatCoarseSensorsMakeEqual) {
  RecordingSignals signals = two_coarse_sensors([](std::size_t) { return false; });
  EXPECT_FALSE(find_dropout(signals).has_value());
}

TEST(SamplingChecks, CountLostRowsOfCoarseSensors) {
  RecordingSignals signals = two_coarse_sensors([](std::size_t row) { return row % 100 > 97; });
  const auto fault = find_dropout(signals);
  ASSERT_TRUE(fault.has_value());
  // 480 rows beside 120 that chance makes equal, three standard deviations of which are 33.
  EXPECT_NEAR(fault->size, 0.02, 0.002);
}

// Sensors in steps of three times their noise, on a machine that rests for 100 rows between two jogs: at the
// edges both are the same together, which looked like hundreds of lost rows.
TEST(SamplingChecks, TakeNoEdgeOfARestForLostRows) {
  RecordingSignals signals = two_stepped_sensors(24000);
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0F, 0.33F);
  float place = 0.0F;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    if (row / 100 % 2 == 0) place += 5.0F;
    for (const Channel channel : {Channel::kSpindleSpeed, Channel::kArmatureCurrent})
      signals.value[index_of(channel)][row] = std::round(place + noise(random));
  }
  EXPECT_FALSE(find_dropout(signals).has_value());
}

// What is the same twice in a position is no speed, and then none again, also where it steps every third row.
TEST(SamplingChecks, TakeNoRowForLostThatAnEncoderMakesEqual) {
  for (const double rows_per_step : {2.5, 3.0, 10.0}) {
    RecordingSignals signals;
    signals.rate_hz = 1000.0;
    signals.rows = 20000;
    auto& position = signals.value[index_of(Channel::kFeedPosition)];
    auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
    signals.recorded = bit_of(Channel::kFeedPosition) | bit_of(Channel::kFeedSpeed);
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, rows_per_step < 10.0 ? 0.2 : 1.0);
    for (std::size_t row = 0; row < signals.rows; ++row) {
      const double steps = 1000.0 / rows_per_step * std::sin(1.0e-3 * static_cast<double>(row));
      position.push_back(static_cast<float>(1.0e-6 * std::round(steps + noise(random))));
      speed.push_back(row == 0 ? 0.0F : 1000.0F * (position[row] - position[row - 1]));
    }
    Sensors sensors;
    sensors[Channel::kFeedPosition] = {.noise = 1.0e-6, .lsb = 1.0e-6};
    sensors[Channel::kFeedSpeed] = {.noise = 2.0e-3, .lsb = 1.0e-3};
    EXPECT_TRUE(find_quantization(signals, sensors).empty());
    EXPECT_FALSE(find_dropout(signals).has_value()) << rows_per_step << " rows per step";
  }
}

TEST(BeginningOf, HasItsRowsAndNoOthers) {
  RecordingSignals signals = record(short_run({}));
  constexpr std::size_t kRows = 3000;
  for (auto& column : signals.value)
    if (!column.empty()) column[100] = column[5000] = std::numeric_limits<float>::quiet_NaN();
  const RecordingSignals beginning = beginning_of(signals, kRows);
  EXPECT_EQ(beginning.rows, kRows);
  EXPECT_EQ(beginning.missing_rows, 1U);
  for (std::size_t c = 0; c < kChannelCount; ++c)
    EXPECT_EQ(beginning.value[c].size(), signals.value[c].empty() ? 0U : kRows);
  EXPECT_EQ(beginning_of(signals, 2 * signals.rows).rows, signals.rows);
}

TEST(Thinned, KeepsSamplesAndAveragesInputs) {
  RecordingSignals signals;
  signals.rate_hz = 1000.0;
  signals.rows = 7;
  signals.recorded = static_cast<std::uint16_t>(bit_of(Channel::kFeedForce) | bit_of(Channel::kFeedPosition));
  signals.value[index_of(Channel::kFeedForce)] = {1, 2, 6, 4, 5, 9, 100};
  signals.value[index_of(Channel::kFeedPosition)] = {1, 2, 3, 4, 5, 6, 7};
  const RecordingSignals thin = thinned(signals, 3);
  EXPECT_EQ(thin.rows, 2U);
  EXPECT_NEAR(thin.rate_hz, 1000.0 / 3.0, 1.0e-9);
  EXPECT_EQ(thin.value[index_of(Channel::kFeedForce)], (std::vector<float>{3, 6}));
  EXPECT_EQ(thin.value[index_of(Channel::kFeedPosition)], (std::vector<float>{1, 4}));
  EXPECT_TRUE(thin.has(Channel::kFeedPosition));
  EXPECT_FALSE(thin.has(Channel::kFeedSpeed));
}

}  // namespace
}  // namespace morepro::host
