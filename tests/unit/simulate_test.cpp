#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim_host/simulate/datasheet.hpp"
#include "sim_host/simulate/random_numbers.hpp"
#include "sim_host/simulate/simulation.hpp"

namespace morepro::host {
namespace {

std::vector<SensorFrame> run(const MonitorConfiguration& configuration, const SimulationOptions& options) {
  Simulation simulation(configuration, options);
  std::vector<SensorFrame> frames;
  for (SensorFrame frame; simulation.next(frame);) frames.push_back(frame);
  return frames;
}

/// A machine whose sensors are exact, so that a test sees the plant.
MonitorConfiguration noiseless(MonitorConfiguration configuration) {
  for (SensorNoise& sensor : configuration.sensors.by_channel) {
    if (sensor.noise > 0.0) sensor.noise = 1e-12;
  }
  return configuration;
}

TEST(NormalNumbers, HaveMeanZeroVarianceOneAndKurtosisThree) {
  NormalNumbers normal(1);
  constexpr int kCount = 400000;
  double sum = 0.0, sum2 = 0.0, sum4 = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = normal.next();
    sum += x;
    sum2 += x * x;
    sum4 += x * x * x * x;
  }
  // Five standard errors of each estimate: 1, sqrt(2), sqrt(96) over sqrt(N).
  const double error = 5.0 / std::sqrt(kCount);
  EXPECT_NEAR(sum / kCount, 0.0, error);
  EXPECT_NEAR(sum2 / kCount, 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(sum4 / kCount, 3.0, error * std::sqrt(96.0));
}

/// Mean over the last second: the dither of a production run moves the speed by 0.2 %.
double settled(const std::vector<SensorFrame>& frames, Channel channel) {
  double sum = 0.0;
  for (std::size_t k = frames.size() - 10000; k < frames.size(); ++k)
    sum += static_cast<double>(frames[k].get(channel));
  return sum / 10000.0;
}

TEST(Simulation, ReferenceMachineReachesTheCutOfItsDatasheet) {
  // Physics: 48 V give 577.7 rad/s and 2.226 A in contact at 0.05 mm and 500 degC.
  const auto frames =
      run(noiseless(reference_configuration()), {.profile = ProfileKind::kProduction, .duration_s = 2.0});
  EXPECT_NEAR(settled(frames, Channel::kSpindleSpeed), 577.7, 0.2);
  EXPECT_NEAR(settled(frames, Channel::kArmatureCurrent), 2.226, 0.01);
  EXPECT_NEAR(settled(frames, Channel::kArmatureVoltage), 48.0, 0.05);
  EXPECT_NEAR(settled(frames, Channel::kFeedForce), 22.0 + 200.0 * settled(frames, Channel::kFeedSpeed), 0.1);
}

TEST(Simulation, ThesisMachineReachesItsCut) {
  // Physics: 48 V give 93.6 rad/s and 48.8 A in contact.
  const auto frames =
      run(noiseless(thesis_configuration()), {.profile = ProfileKind::kProduction, .duration_s = 2.0});
  EXPECT_NEAR(settled(frames, Channel::kSpindleSpeed), 93.6, 0.1);
  EXPECT_NEAR(settled(frames, Channel::kArmatureCurrent), 48.8, 0.2);
}

TEST(Simulation, NoiseIsTheSensorsNoise) {
  const SimulationOptions options{.profile = ProfileKind::kRich, .duration_s = 1.0};
  MonitorConfiguration quantised = reference_configuration();
  quantised.sensors[Channel::kSpindleSpeed].lsb = 0.5;
  const auto noisy = run(quantised, options);
  const auto exact = run(noiseless(reference_configuration()), options);
  double sum2 = 0.0;
  for (std::size_t k = 0; k < noisy.size(); ++k) {
    const double speed = static_cast<double>(noisy[k].get(Channel::kSpindleSpeed));
    EXPECT_EQ(std::remainder(speed, 0.5), 0.0);
    sum2 += std::pow(speed - static_cast<double>(exact[k].get(Channel::kSpindleSpeed)), 2);
  }
  // The voltage of this profile is open loop: both runs move alike. Variance 1 + 0.5^2/12, five standard
  // errors.
  EXPECT_NEAR(sum2 / static_cast<double>(noisy.size()), 1.0208, 5.0 * std::sqrt(2.0 / 10000.0));
}

TEST(Simulation, CuttingChangesTheChipLoadDuringTheContact) {
  const auto frames = run(reference_configuration(), {.profile = ProfileKind::kCutting, .duration_s = 1.0});
  ASSERT_EQ(frames.size(), 10000U);
  const auto at = [&frames](std::size_t k, Channel channel) { return frames[k].get(channel); };
  EXPECT_EQ(at(1000, Channel::kContact), 0.0F);
  EXPECT_EQ(at(5000, Channel::kContact), 1.0F);
  EXPECT_EQ(at(5000, Channel::kChipLoad), 0.05F);
  EXPECT_EQ(at(6000, Channel::kContact), 1.0F);
  EXPECT_EQ(at(6000, Channel::kChipLoad), 0.04F);
  EXPECT_EQ(at(9500, Channel::kContact), 0.0F);
}

TEST(Simulation, TheTableComesBackAfterEachMinute) {
  // Beyond some 4 m a float of 32 bits adds its own steps to a sensor of 1 um.
  constexpr double kStepS = 0.01;
  for (const ProfileKind kind :
       {ProfileKind::kCommissioning, ProfileKind::kProduction, ProfileKind::kCutting}) {
    const Profile profile(kind, reference_machine(), 3600.0, 1);
    double position_m = 0.0, lowest_m = 0.0, highest_m = 0.0;
    for (double time_s = 0.0; time_s < 3600.0; time_s += kStepS) {
      const Command command = profile.at(time_s);
      position_m += command.feed_speed_m_s * kStepS;
      lowest_m = std::min(lowest_m, position_m);
      highest_m = std::max(highest_m, position_m);
      const bool returns = command.feed_speed_m_s < 0.0;
      ASSERT_FALSE(returns && command.contact > 0.0) << time_s;
      // The first minute is one way: recordings of a minute are what they are without a return.
      ASSERT_FALSE(returns && time_s < 60.0) << time_s;
    }
    EXPECT_GT(lowest_m, -0.3);
    EXPECT_LT(highest_m, 1.5);
    EXPECT_GT(highest_m, 0.8);
  }
}

TEST(Simulation, RichExcitesBothDirectionsAndBothContactStates) {
  const auto frames = run(reference_configuration(), {.profile = ProfileKind::kRich, .duration_s = 2.0});
  float lowest = 0.0F, highest = 0.0F;
  int in_contact = 0;
  for (const SensorFrame& frame : frames) {
    lowest = std::min(lowest, frame.get(Channel::kSpindleSpeed));
    highest = std::max(highest, frame.get(Channel::kSpindleSpeed));
    in_contact += frame.get(Channel::kContact) > 0.5F ? 1 : 0;
  }
  EXPECT_LT(lowest, -500.0F);
  EXPECT_GT(highest, 500.0F);
  EXPECT_NEAR(in_contact / 20000.0, 0.4, 0.1);
}

TEST(Simulation, SampledAtAnyRateMovesTheSameMachine) {
  // 0.2 % of dither in the voltage moves the speed by 1.2 rad/s.
  for (const double rate_hz : {1000.0, 5000.0, 20000.0}) {
    const auto frames = run(noiseless(reference_configuration()),
                            {.profile = ProfileKind::kProduction, .duration_s = 1.0, .rate_hz = rate_hz});
    EXPECT_EQ(frames.size(), static_cast<std::size_t>(rate_hz));
    EXPECT_NEAR(frames.back().get(Channel::kSpindleSpeed), 577.7F, 1.5F);
  }
}

TEST(Datasheet, IsWrongByTheFractionEverywhere) {
  const MachineParameters machine = reference_machine();
  const MachineParameters datasheet = datasheet_of(machine, 0.2, 3);
  EXPECT_NEAR(std::fabs(datasheet.spindle.inertia_kgm2 / machine.spindle.inertia_kgm2 - 1.0), 0.2, 1e-12);
  EXPECT_NEAR(std::fabs(datasheet.feed.mass_kg / machine.feed.mass_kg - 1.0), 0.2, 1e-12);
  EXPECT_EQ(datasheet.tool.diameter_mm, machine.tool.diameter_mm);
  EXPECT_EQ(datasheet_of(machine, 0.2, 3).spindle.resistance_ohm, datasheet.spindle.resistance_ohm);
}

}  // namespace
}  // namespace morepro::host
