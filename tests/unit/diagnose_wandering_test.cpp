// Loads that come and go by themselves: an observer takes them for random forces, and nobody sees a gap.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim_host/diagnose/leftover/wandering.hpp"
#include "tests/unit/driven_spindle.hpp"

namespace morepro::diagnose_test {
namespace {

constexpr double kLoadRateHz = 2000.0;
constexpr std::size_t kLoadRows = 32000;
constexpr double kLoadNm = 0.02;

/// That works one way for 0.1 s on average, then the other way.
std::vector<double> load_that_turns() {
  std::mt19937 random(3);
  std::exponential_distribution<double> rows(1.0 / (0.1 * kLoadRateHz));
  std::vector<double> load;
  for (double now = kLoadNm; load.size() < kLoadRows; now = -now)
    load.insert(load.end(), static_cast<std::size_t>(rows(random)), now);
  return load;
}

/// As large on average, with a memory.
std::vector<double> random_load(double memory_s) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, kLoadNm);
  const double kept = std::exp(-1.0 / (kLoadRateHz * memory_s));
  std::vector<double> load(kLoadRows, normal(random));
  for (std::size_t row = 1; row < kLoadRows; ++row)
    load[row] = kept * load[row - 1] + std::sqrt(1.0 - kept * kept) * normal(random);
  return load;
}

DiagnosisResult diagnosed_with(const std::vector<double>& load_nm) {
  DrivenSpindle spindle{.rate_hz = kLoadRateHz, .rows = kLoadRows};
  spindle.load_at = [&load_nm](double time_s) {
    return load_nm[static_cast<std::size_t>(std::lround(time_s * kLoadRateHz))];
  };
  return diagnosed(record(spindle), datasheet(0.0));
}

TEST(WanderingLoad, IsUnexplained) {
  const DiagnosisResult result = diagnosed_with(load_that_turns());
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  ASSERT_EQ(result.unexplained_follows.size(), 1U);
  EXPECT_EQ(result.unexplained_follows.front().balance, gap::Balance::kSpindleTorque);
  EXPECT_NE(result.unexplained_follows.front().signal.find("its own past"), std::string::npos)
      << result.unexplained_follows.front().signal;
}

TEST(WanderingLoad, IsNotWhatLastsForMilliseconds) {
  for (const double memory_s : {0.001, 0.008, 0.04}) {
    const DiagnosisResult result = diagnosed_with(random_load(memory_s));
    EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << memory_s << " s: " << said(result);
  }
}

// What such an observer leaves has to be summed up again, and next to nothing is found in that: a right
// machine whose current was 1.4 times as noisy as stated was "unexplained".
TEST(WanderingLoad, IsNotToldWhereAnObserverTakesNoiseForForces) {
  RecordingSignals signals = record(SimulatedRun{.duration_s = 8.0});
  auto& current = signals.value[index_of(Channel::kArmatureCurrent)];
  for (std::size_t row = 0; row < signals.rows; ++row)
    current[row] += static_cast<float>(0.02 * std::sin(9.0 * signals.time_s(row)));
  host::AxisFit fit(host::Axis::kSpindle, signals, gap_model(datasheet(0.0), signals));
  EXPECT_GT(host::wandering_of(fit).deviance, 0.0);
  fit.expect_noise(1.5);
  EXPECT_EQ(host::wandering_of(fit).deviance, 0.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
