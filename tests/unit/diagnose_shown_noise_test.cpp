// Machine files state noise that is too low. A sensor that is noisier is not a machine that is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sim_host/diagnose/signals/shown_noise.hpp"
#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

constexpr double kNoise = 2.0e-4;

/// `motion` in each row, beside white noise.
std::vector<float> noisy(const std::function<double(int)>& motion) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, kNoise);
  std::vector<float> column;
  for (int row = 0; row < 20000; ++row) column.push_back(static_cast<float>(motion(row) + normal(random)));
  return column;
}

// Of 78 blocks of 256 values each: two percent of a standard deviation, and four of them.
constexpr double kChance = 0.08;

TEST(WhiteNoise, IsWhatNeighboursDoNotShare) {
  const auto at_rest = noisy([](int) { return 0.0; });
  EXPECT_NEAR(host::white_noise_of(at_rest, 1), kNoise, kChance * kNoise);
  EXPECT_NEAR(host::white_noise_of(at_rest, 2), kNoise, kChance * kNoise);
  const auto ramp = noisy([](int row) { return 1.0e-4 * row; });
  EXPECT_NEAR(host::white_noise_of(ramp, 1), kNoise, kChance * kNoise);
}

TEST(WhiteNoise, IsNoRandomWalkAndNoWave) {
  std::mt19937 random(5);
  std::normal_distribution<double> step(0.0, kNoise);
  double place = 0.0;
  const auto walk = noisy([&](int) { return place += step(random); });
  // Its steps scatter by half as much again.
  EXPECT_NEAR(host::white_noise_of(walk, 1), kNoise, 1.5 * kChance * kNoise);
  // Below what counts as noisier than stated, whatever its rate per row and its size.
  for (const double rate : {0.1, 1.7, 2.2, 2.5, 2.8})
    for (const double size : {0.5, 1.1, 2.0, 10.0}) {
      const auto wave = [&](int row) { return size * kNoise * std::sin(rate * row); };
      EXPECT_LT(host::white_noise_of(noisy(wave), 1), 1.5 * kNoise) << rate << ", " << size;
    }
}

TEST(WhiteNoise, IsNotMovedByOutliersAndHoles) {
  auto column = noisy([](int row) { return 0.1 * std::sin(1.0e-3 * row); });
  for (std::size_t row = 7; row < column.size(); row += 97) column[row] += 1.0F;
  for (std::size_t row = 0; row < column.size(); row += 31)
    column[row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(host::white_noise_of(column, 1), kNoise, 2.0 * kChance * kNoise);
  // With so few neighbours left that further lags are not known, a wave must not pass for noise.
  auto wave = noisy([](int row) { return 10.0 * kNoise * std::sin(2.2 * row); });
  for (std::size_t row = 0; row < wave.size(); row += 7) wave[row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_LT(host::white_noise_of(wave, 2), 1.5 * kNoise);
  column.resize(1000);
  EXPECT_EQ(host::white_noise_of(column, 1), 0.0) << "too little to tell";
}

/// The axis of the tests by a machine file that states `share` of the noise.
DiagnosisResult diagnosed_with_noise(double share, const DrivenAxis& axis, MachineDescription& found) {
  MachineDescription sheet = datasheet(0.05);
  sheet.has_spindle = false;
  sheet.configuration.sensors[Channel::kFeedSpeed].noise *= share;
  sheet.configuration.sensors[Channel::kFeedPosition].noise = share * axis.position_noise_m;
  host::DiagnosisOptions options;
  options.bootstrap_runs = 0;
  return host::diagnose(record(axis), sheet, options, found);
}

std::ptrdiff_t said_of(const DiagnosisResult& result, std::string_view words) {
  return std::ranges::count_if(
      result.notices, [words](const std::string& notice) { return notice.find(words) != std::string::npos; });
}

// It was structure that nothing explains, with 24 to 41 times its noise.
TEST(NoisierThanStated, IsNoGapOfTheMachine) {
  const DrivenAxis axis;
  MachineDescription found;
  const auto result = diagnosed_with_noise(0.4, axis, found);
  EXPECT_EQ(result.verdict, host::Verdict::kParameterError) << said(result);
  EXPECT_EQ(said_of(result, "feed_speed_m_s is 2."), 1);
  EXPECT_EQ(said_of(result, "times as noisy"), 2);
  // What is written for the next run says so.
  EXPECT_NEAR(found.configuration.sensors[Channel::kFeedPosition].noise, axis.position_noise_m,
              kChance * axis.position_noise_m);
  EXPECT_EQ(said_of(diagnosed_with_noise(0.8, axis, found), "times as noisy"), 0);
}

// Sampled so slowly that an axis moves by more than the noise from one sample to the next and back, no sample
// shows it. What a model leaves of them does; both sensors twice as noisy had 20.6 times the noise, which
// nothing explained, in seven of eight recordings of another simulator.
TEST(NoisierThanStated, IsSeenBehindAMotionThatIsAsFast) {
  SimulatedRun run{.duration_s = 30.0, .rate_hz = 500.0};
  run.configuration.sensors[Channel::kFeedPosition].noise = 1.0e-6;
  const RecordingSignals signals = record(run);
  MachineDescription sheet = datasheet(0.1);
  sheet.has_spindle = false;
  for (const Channel channel : {Channel::kFeedSpeed, Channel::kFeedPosition})
    sheet.configuration.sensors[channel].noise = 0.5 * run.configuration.sensors[channel].noise;
  ASSERT_TRUE(host::noisier_than_stated(signals, sheet.configuration.sensors).empty()) << "no test of it";
  MachineDescription found;
  host::DiagnosisOptions options;
  options.bootstrap_runs = 0;
  const auto result = host::diagnose(signals, sheet, options, found);
  EXPECT_EQ(result.verdict, host::Verdict::kParameterError) << said(result);
  EXPECT_EQ(said_of(result, "times as noisy"), 2);
  EXPECT_NEAR(found.configuration.sensors[Channel::kFeedPosition].noise, 1.0e-6, 2.0 * kChance * 1.0e-6);
}

// Random forces are new in every row, too, and no sensor's.
TEST(NoisierThanStated, IsNoSensorOfAMachineThatShakes) {
  for (const double process_noise : {1.0, 10.0}) {
    const auto signals = record({.duration_s = 20.0, .rate_hz = 500.0, .process_noise = process_noise});
    EXPECT_EQ(said_of(diagnosed(signals, datasheet(0.1)), "times as noisy"), 0) << process_noise;
  }
}

TEST(NoisierThanStated, LeavesAFrictionItsName) {
  const DrivenAxis axis{.brake_at = [](double speed_m_s) { return 8.0 * std::tanh(speed_m_s / 1.0e-3); }};
  MachineDescription found;
  const auto result = diagnosed_with_noise(0.4, axis, found);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedCoulombFriction);
  EXPECT_NEAR(result.which.front().magnitude, 8.0, 0.4);
}

constexpr std::array kSensed{Channel::kSpindleSpeed, Channel::kFeedSpeed, Channel::kFeedPosition,
                             Channel::kArmatureCurrent};

/// Sensors of the reference machine with another noise, of which no machine file says anything.
SimulatedRun with_noise_of(double share, SimulatedRun run) {
  for (SensorNoise& sensor : run.configuration.sensors.by_channel) sensor.noise *= share;
  return run;
}
SimulatedRun in_production() {
  return {.duration_s = 10.0, .rate_hz = 2000.0, .seed = 5, .profile = host::ProfileKind::kProduction};
}
std::uint16_t all_of_them() {
  std::uint16_t bits = 0;
  for (const Channel channel : kSensed) bits = static_cast<std::uint16_t>(bits | bit_of(channel));
  return bits;
}

/// By what factor the noise of a sensor is another one than usual, as far as it shows; 1: nothing is taken.
double shown(Channel channel, const RecordingSignals& signals, std::uint16_t assumed = all_of_them()) {
  const auto others = host::instead_of_assumed(signals, assumed, reference_configuration().sensors);
  const auto found = std::ranges::find(others, channel, &host::ShownNoise::channel);
  return found == others.end() ? 1.0 : found->ratio;
}

// Whatever it is, up and down, as long as the columns show it for sure; what a machine file states is not
// touched.
TEST(AssumedNoise, IsTakenFromWhatTheSensorsShow) {
  for (const double share : {0.1, 1.0, 5.0}) {
    const auto signals = record(with_noise_of(share, in_production()));
    for (const Channel channel : {Channel::kSpindleSpeed, Channel::kFeedSpeed, Channel::kFeedPosition}) {
      EXPECT_NEAR(shown(channel, signals), share, kChance * share);
      EXPECT_EQ(shown(channel, signals, 0), 1.0);
    }
  }
}

// A current answers the voltage of its row. What no law of the row before predicts of it is more than its
// noise, by what the row before is noisy itself, and by the controller's answer to that.
TEST(AssumedNoise, OfACurrentIsABound) {
  const auto quiet = record(with_noise_of(0.1, in_production()));
  EXPECT_GE(shown(Channel::kArmatureCurrent, quiet), 0.1);
  EXPECT_LT(shown(Channel::kArmatureCurrent, quiet), 0.3);
  EXPECT_EQ(shown(Channel::kArmatureCurrent, record(with_noise_of(5.0, in_production()))), 1.0);
  RecordingSignals blind = quiet;
  leave_out(blind, Channel::kArmatureVoltage);
  EXPECT_EQ(shown(Channel::kArmatureCurrent, blind), 1.0);
  RecordingSignals holed = quiet;
  for (std::size_t row = 0; row < holed.rows; row += 7)
    holed.value[index_of(Channel::kSpindleSpeed)][row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(shown(Channel::kArmatureCurrent, holed), shown(Channel::kArmatureCurrent, quiet), 0.03);
}

// Simulations without noise differ from each other all the same.
TEST(AssumedNoise, IsNeverNone) {
  RecordingSignals signals = record(in_production());
  signals.value[index_of(Channel::kSpindleSpeed)] = noisy([](int) { return 0.0; });
  EXPECT_NEAR(shown(Channel::kSpindleSpeed, signals), 1.0 / 30.0, 1.0e-9);
}

// A speed that is believed to be ten times noisier than it is leaves everything to the current, and what that
// does not know was structure without a name.
TEST(AssumedNoise, IsNoGapOfALargerMotor) {
  SimulatedRun run = in_production();
  run.duration_s = 12.0;
  auto& spindle = run.configuration.machine.spindle;
  spindle.torque_constant_nm_a = spindle.back_emf_constant_vs_rad = 0.52;
  spindle.resistance_ohm = 0.42;
  spindle.inductance_h = 3.2e-3;
  spindle.inertia_kgm2 = 4.2e-3;
  spindle.viscous_friction_nms_rad = 1.2e-3;
  run.configuration.sensors[Channel::kSpindleSpeed].noise = 0.1;
  run.configuration.sensors[Channel::kArmatureCurrent].noise = 0.1;
  MachineDescription sheet = datasheet(0.0);
  sheet.has_feed = false;
  sheet.configuration.machine = host::datasheet_of(run.configuration.machine, 0.2, 5);
  sheet.assumed_noise = all_of_them();
  EXPECT_EQ(diagnosed(record(run), sheet).verdict, host::Verdict::kParameterError);
}

// Of 2 V nothing was said: with a thirtieth of the usual noise a wrong model was likelier than the right one.
TEST(AssumedNoise, DoesNotHideACause) {
  SimulatedRun run = with_noise_of(0.03, in_production());
  run.effects = {effect(Effect::kSupplyVoltageOffset, 2.0)};
  const RecordingSignals signals = record(run);
  MachineDescription sheet = wrong_datasheet(5);
  sheet.assumed_noise = all_of_them();
  const auto result = diagnosed(signals, sheet);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_TRUE(names(result.which.front(), Effect::kSupplyVoltageOffset)) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
