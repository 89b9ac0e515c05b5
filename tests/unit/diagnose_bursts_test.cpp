// Sensors that hang, lines that are disturbed: a robust fit leaves such rows out, and nobody sees a gap.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim_host/diagnose/leftover/bursts.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::AxisFit;
using host::Bursts;

constexpr SimulatedRun kRun{.duration_s = 2.0, .rate_hz = 5000.0};
constexpr std::size_t kApart = 701;  // rows, from one moment to the next

std::vector<Bursts> bursts_of(const RecordingSignals& signals, Axis axis = Axis::kSpindle) {
  return host::bursts_of(AxisFit(axis, signals, gap_model(datasheet(0.0), signals)));
}

template <class Disturb>
RecordingSignals disturbed(std::size_t rows, Disturb disturb) {
  RecordingSignals signals = record(kRun);
  for (std::size_t first = kApart; first + rows < signals.rows; first += kApart)
    for (std::size_t row = first; row < first + rows; ++row) disturb(signals, row);
  return signals;
}

void hang(RecordingSignals& signals, std::size_t row) {
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  speed[row] = speed[row - 1];
}

void spike(RecordingSignals& signals, std::size_t row) {
  signals.value[index_of(Channel::kArmatureCurrent)][row] += row % 2 == 0 ? 2.0F : -1.5F;
}

TEST(Bursts, AreNoneWhereTheModelIsRight) {
  const RecordingSignals signals = record(kRun);
  EXPECT_TRUE(bursts_of(signals).empty());
  EXPECT_TRUE(bursts_of(signals, Axis::kFeed).empty());
}

TEST(Bursts, AreASensorThatHangs) {
  const std::vector<Bursts> found = bursts_of(disturbed(40, hang));
  ASSERT_FALSE(found.empty());
  const Bursts& bursts = found.front();
  EXPECT_EQ(bursts.channel, Channel::kSpindleSpeed);
  EXPECT_TRUE(bursts.hangs);
  // Of fourteen: where the speed is even, what hangs shows nothing else; a speed that crosses its last sample
  // makes two.
  EXPECT_GE(bursts.times, 5U);
  EXPECT_LE(bursts.times, 20U);
  EXPECT_GT(bursts.deviance, host::kLeastUnnamed);
}

TEST(Bursts, AreALineThatIsDisturbed) {
  const std::vector<Bursts> found = bursts_of(disturbed(4, spike));
  ASSERT_EQ(found.size(), 1U);
  const Bursts& bursts = found.front();
  EXPECT_EQ(bursts.channel, Channel::kArmatureCurrent);
  EXPECT_FALSE(bursts.hangs);
  EXPECT_EQ(bursts.times, 14U);
  EXPECT_NEAR(bursts.first_s, static_cast<double>(kApart) / kRun.rate_hz, 1.0e-9);
}

RecordingSignals with_more_noise(double share, auto distribution) {
  std::mt19937 random(7);
  RecordingSignals signals = record(kRun);
  const double noise = share * reference_configuration().sensors[Channel::kSpindleSpeed].noise;
  for (float& speed : signals.value[index_of(Channel::kSpindleSpeed)])
    speed += static_cast<float>(noise * distribution(random));
  return signals;
}

TEST(Bursts, AreNoNoise) {
  EXPECT_TRUE(bursts_of(with_more_noise(1.0, std::student_t_distribution<double>(3.0))).empty());
  EXPECT_TRUE(bursts_of(with_more_noise(3.0, std::normal_distribution<double>())).empty());
  EXPECT_TRUE(bursts_of(disturbed(1, spike)).empty());
}

TEST(Bursts, AreNoMomentThatComesOnce) {
  RecordingSignals signals = record(kRun);
  for (std::size_t row = 5000; row < 5007; ++row) spike(signals, row);
  EXPECT_TRUE(bursts_of(signals).empty());
}

TEST(Bursts, AreNoHealthAndSaidInWords) {
  const DiagnosisResult result = diagnosed(disturbed(40, hang), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_EQ(result.unexplained_follows.front().balance, gap::Balance::kSpindleTorque);
  const std::string& words = result.unexplained_follows.front().signal;
  EXPECT_NE(words.find("spindle_speed_rad_s shows what nothing leads to"), std::string::npos) << words;
  EXPECT_NE(words.find("it repeats its last sample there"), std::string::npos) << words;
}

// Which repeats itself anyway.
TEST(Bursts, OfACoarseSensorDoNotSayThatItHangs) {
  RecordingSignals signals = disturbed(8, [](RecordingSignals& run, std::size_t row) {
    run.value[index_of(Channel::kArmatureCurrent)][row] += 40.0F;
  });
  for (float& current : signals.value[index_of(Channel::kArmatureCurrent)])
    current = 8.0F * std::round(current / 8.0F);
  const std::vector<Bursts> found = bursts_of(signals);
  ASSERT_FALSE(found.empty());
  for (const Bursts& bursts : found) EXPECT_FALSE(bursts.hangs) << bursts.rows;
}

}  // namespace
}  // namespace morepro::diagnose_test
