#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "lib/plant/contact_law.hpp"
#include "sim_host/simulate/simulation.hpp"

namespace morepro::host {
namespace {

/// One round of the rich profile's four speeds.
const std::vector<SensorFrame>& round_of_rich() {
  static const std::vector<SensorFrame> frames = [] {
    Simulation simulation(reference_configuration(), {.profile = ProfileKind::kRich, .duration_s = 8.0});
    std::vector<SensorFrame> all;
    for (SensorFrame frame; simulation.next(frame);) all.push_back(frame);
    return all;
  }();
  return frames;
}

struct Range {
  double lowest = 1.0e9;
  double highest = -1.0e9;
  void take(float value) {
    lowest = std::min(lowest, static_cast<double>(value));
    highest = std::max(highest, static_cast<double>(value));
  }
};

TEST(RichProfile, VariesChipLoadAndEngagementInContact) {
  std::set<float> chip_loads, engagements;
  for (const SensorFrame& frame : round_of_rich()) {
    if (frame.get(Channel::kContact) == 0.0F) continue;
    chip_loads.insert(frame.get(Channel::kChipLoad));
    engagements.insert(frame.get(Channel::kEngagement));
  }
  EXPECT_GE(chip_loads.size(), 4U);
  EXPECT_GE(engagements.size(), 3U);
  EXPECT_GT(*chip_loads.rbegin(), 1.3F * *chip_loads.begin());
}

TEST(RichProfile, VariesSpeedAndToolTemperatureInContact) {
  Range speed, temperature;
  for (const SensorFrame& frame : round_of_rich()) {
    if (frame.get(Channel::kContact) == 0.0F) continue;
    speed.take(std::fabs(frame.get(Channel::kSpindleSpeed)));
    temperature.take(frame.get(Channel::kToolTemperature));
  }
  EXPECT_LT(speed.lowest, 0.6 * 577.7);
  EXPECT_GT(speed.highest, 577.7);
  EXPECT_GT(temperature.highest - temperature.lowest, 30.0);
  // The kink of the contact law at 400 degC stays away from the noise.
  EXPECT_GT(temperature.lowest, 430.0);
}

TEST(RichProfile, HeatsTheWindingWithinWhatItStands) {
  Range winding;
  for (const SensorFrame& frame : round_of_rich()) winding.take(frame.get(Channel::kWindingTemperature));
  EXPECT_GT(winding.highest - winding.lowest, 30.0);
  EXPECT_LT(winding.highest, 155.0);
}

TEST(RichProfile, RunsSlowlyThroughReversalsInTheAir) {
  int slow = 0, reversals = 0;
  float last = 0.0F;
  for (const SensorFrame& frame : round_of_rich()) {
    const float speed = frame.get(Channel::kSpindleSpeed);
    const bool is_slow_phase = frame.time_us >= 4000000U && frame.time_us < 6000000U;
    if (!is_slow_phase) continue;
    EXPECT_EQ(frame.get(Channel::kContact), 0.0F);
    slow += std::fabs(speed) < 58.0F ? 1 : 0;
    // Beyond 5 rad/s it is no noise.
    if (std::fabs(speed) < 5.0F) continue;
    reversals += speed * last < 0.0F ? 1 : 0;
    last = speed;
  }
  EXPECT_GT(slow, 5000);
  EXPECT_GT(reversals, 10);
}

TEST(Simulation, CutsAtTheTemperatureThatTheSensorShows) {
  MonitorConfiguration exact = reference_configuration();
  for (SensorNoise& sensor : exact.sensors.by_channel) {
    if (sensor.noise > 0.0) sensor.noise = 1.0e-12;
  }
  const auto& spindle = exact.machine.spindle;
  const ContactLaw<double> law(exact.machine);
  Simulation simulation(exact, {.profile = ProfileKind::kCutting, .duration_s = 5.0});
  double worst = 0.0, coldest = 500.0;
  for (SensorFrame frame; simulation.next(frame);) {
    if (frame.get(Channel::kContact) == 0.0F) continue;
    const auto at = [&frame](Channel channel) { return static_cast<double>(frame.get(channel)); };
    const double speed = at(Channel::kSpindleSpeed);
    const double cut_nm = law(speed, at(Channel::kChipLoad), at(Channel::kToolTemperature)).torque_nm;
    const double net_nm = spindle.torque_constant_nm_a * at(Channel::kArmatureCurrent) -
                          spindle.viscous_friction_nms_rad * speed - cut_nm;
    worst = std::max(worst, std::fabs(net_nm - spindle.inertia_kgm2 * at(Channel::kSpindleAcceleration)));
    coldest = std::min(coldest, at(Channel::kToolTemperature));
  }
  EXPECT_LT(coldest, 490.0);
  // Floats of 0.2 N m; 10 degC more would be 2e-3 N m.
  EXPECT_LT(worst, 1.0e-6);
}

}  // namespace
}  // namespace morepro::host
