// How often an axis passes standstill decides whether a part of the recording can stand for all of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sim_host/diagnose/fit/standstill.hpp"

namespace morepro::host {
namespace {

constexpr double kRateHz = 1000.0;

/// An axis that goes there and back `turns` times within ten seconds, seen by a sensor with a tenth of noise.
RecordingSignals shuttle(int turns, double noise = 0.1) {
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = 10000;
  std::mt19937 random(1);
  std::normal_distribution<float> sensor(0.0F, static_cast<float>(noise));
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double phase = static_cast<double>(turns * 2 * row / signals.rows);
    const float speed = std::fmod(phase, 2.0) < 1.0 ? 1.0F : -1.0F;
    signals.value[index_of(Channel::kFeedSpeed)].push_back(speed + sensor(random));
  }
  return signals;
}

TEST(Standstill, IsPassedSeldomByAnAxisThatTurnsBackAFewTimes) {
  EXPECT_TRUE(passes_standstill_seldom(shuttle(1)));
  EXPECT_TRUE(passes_standstill_seldom(shuttle(3)));
  EXPECT_FALSE(passes_standstill_seldom(shuttle(20)));
}

TEST(Standstill, IsNotPassedByAnAxisThatKeepsItsWay) {
  RecordingSignals signals = shuttle(3);
  for (float& speed : signals.value[index_of(Channel::kFeedSpeed)]) speed = std::fabs(speed);
  EXPECT_FALSE(passes_standstill_seldom(signals));
}

TEST(Standstill, IsPassedByAnAxisThatStopsAndGoesOn) {
  RecordingSignals signals = shuttle(3);
  for (float& speed : signals.value[index_of(Channel::kFeedSpeed)]) speed = std::max(speed, 0.0F);
  EXPECT_TRUE(passes_standstill_seldom(signals));
}

// At rest, noise of the sensor is as large as a motion of a fifth of the fastest.
TEST(Standstill, IsNotPassedByNoise) {
  RecordingSignals signals = shuttle(1, 0.2);
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  for (std::size_t row = 7000; row < signals.rows; ++row) speed[row] += 1.0F;
  EXPECT_TRUE(passes_standstill_seldom(signals));
}

TEST(Standstill, IsUnknownOfAnAxisThatWasNotRecorded) { EXPECT_FALSE(passes_standstill_seldom({})); }

TEST(Standstill, IsSeenThroughSamplesThatWereLost) {
  RecordingSignals signals = shuttle(3);
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  for (std::size_t row = 0; row < signals.rows; row += 3)
    speed[row] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(passes_standstill_seldom(signals));
}

}  // namespace
}  // namespace morepro::host
