#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "sim_host/simulate/simulation.hpp"
#include "tests/support/wrong_datasheet.hpp"

namespace morepro {
namespace {

std::vector<SensorFrame> recorded(const MonitorConfiguration& truth, host::ProfileKind profile,
                                  std::uint64_t seed) {
  host::SimulationOptions options{.profile = profile, .duration_s = 3.0, .seed = seed};
  host::Simulation machine(truth, options);
  std::vector<SensorFrame> frames;
  for (SensorFrame frame; machine.next(frame);) frames.push_back(frame);
  return frames;
}

std::array<ParameterEstimate, kParameterCount> identified(const MonitorConfiguration& datasheet,
                                                          const std::vector<SensorFrame>& frames) {
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(datasheet).ok());
  for (const SensorFrame& frame : frames) (void)monitor->step(frame);
  return monitor->health().parameters;
}

double errors_off(const ParameterEstimate& estimate, double truth) {
  return std::abs(static_cast<double>(estimate.value) - truth) / static_cast<double>(estimate.standard_error);
}

// With measurements that the gates of the datasheet's model had passed, one claim in seven was farther off
// than three standard errors on one machine, and torque constant and inertia were never found on the other.
TEST(MonitorIdentification, FindsTheMachineBehindAWrongDatasheet) {
  int asked = 0, claimed = 0, wrong = 0;
  for (const auto& truth : {thesis_configuration(), reference_configuration()})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const auto frames = recorded(truth, host::ProfileKind::kCommissioning, seed);
      const auto estimates = identified(test::wrong_at_random(truth, 1.3, seed), frames);
      const auto values = test::values_of(truth.machine);
      for (std::size_t j = 0; j < kParameterCount; ++j) {
        ++asked;
        if (estimates[j].status != ParameterStatus::kIdentifiable) continue;
        ++claimed;
        if (errors_off(estimates[j], values[j]) > 3.0) ++wrong;
      }
    }
  EXPECT_GE(claimed, asked * 9 / 10);
  EXPECT_LE(wrong, 1) << "of " << claimed;
}

TEST(MonitorIdentification, SpikesThatASensorCouldShowTeachNothing) {
  const MonitorConfiguration truth = reference_configuration();
  auto frames = recorded(truth, host::ProfileKind::kRich, 1);
  const auto clean = identified(truth, frames);
  for (std::size_t k = 5000; k < frames.size(); k += 997) {
    frames[k].set(Channel::kArmatureCurrent, 60.0F);
    frames[k].set(Channel::kFeedSpeed, -0.5F);
    frames[k + 3].set(Channel::kSpindleSpeed, -300.0F);
  }
  const auto spiked = identified(truth, frames);
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    EXPECT_EQ(spiked[j].status, ParameterStatus::kIdentifiable) << j;
    EXPECT_NEAR(spiked[j].value, clean[j].value, 3.0F * clean[j].standard_error) << j;
  }
}

}  // namespace
}  // namespace morepro
