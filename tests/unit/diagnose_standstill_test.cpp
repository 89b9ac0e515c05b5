// How often an axis passes standstill decides whether a part of the recording can stand for all of it; one
// that never moves shows nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "sim_host/diagnose/fit/standstill.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

constexpr double kRateHz = 1000.0;

/// An axis that goes there and back `turns` times within ten seconds, seen by a sensor with a tenth of noise.
RecordingSignals shuttle(int turns, double noise = 0.1) {
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = 10000;
  signals.recorded = bit_of(Channel::kFeedSpeed);
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

bool are_seen(const std::vector<Stretch>& stretches, std::size_t row) {
  return std::ranges::any_of(stretches, [row](const Stretch& s) { return s.first <= row && row < s.last; });
}

/// 50 s with the rows that a shuttle has in 10 s, which rests until `rested` and goes on at the end.
RecordingSignals shuttle_of_50_s(int turns, std::size_t rested) {
  RecordingSignals signals = shuttle(turns, 0.0);
  signals.rows *= 5;
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  speed.resize(signals.rows, speed.back());
  std::fill_n(speed.begin(), rested, 0.0F);
  return signals;
}

// Two that are far apart, and four of which two pairs are in one sixteenth each.
TEST(Standstill, IsInTheQuarterThatIsLookedAtFirst) {
  for (const auto& [turns, rows] : {std::pair{1, std::vector<std::size_t>{1700, 5000}},
                                    std::pair{3, std::vector<std::size_t>{1700, 3333, 5000, 6666, 8333}}}) {
    const RecordingSignals signals = shuttle_of_50_s(turns, 1700);
    const std::vector<Stretch> telling = telling_quarter_of(Axis::kFeed, signals);
    const std::vector<Stretch> any = quarter_of(signals);
    ASSERT_EQ(telling.size(), any.size());
    EXPECT_TRUE(std::ranges::any_of(rows, [&any](std::size_t row) { return !are_seen(any, row); }));
    for (const std::size_t row : rows) {
      EXPECT_TRUE(are_seen(telling, row - 10)) << row;
      EXPECT_TRUE(are_seen(telling, row + 10)) << row;
    }
    std::size_t before = 0;
    for (std::size_t i = 0; i < any.size(); ++i) {
      EXPECT_GE(telling[i].last - telling[i].first, any[i].last - any[i].first);
      EXPECT_GE(telling[i].first, before);
      before = telling[i].last;
    }
    EXPECT_LE(before, signals.rows);
  }
}

TEST(Standstill, IsNotLookedForWhereItIsOftenOrNotRecorded) {
  RecordingSignals signals = shuttle_of_50_s(6, 1700);
  const auto is_plain = [&signals](Axis axis) {
    return std::ranges::equal(telling_quarter_of(axis, signals), quarter_of(signals), {}, &Stretch::first,
                              &Stretch::first);
  };
  EXPECT_TRUE(is_plain(Axis::kFeed));
  signals = shuttle_of_50_s(1, 1700);
  EXPECT_FALSE(is_plain(Axis::kFeed));
  EXPECT_TRUE(is_plain(Axis::kSpindle));
  signals.value[index_of(Channel::kFeedSpeed)].clear();
  EXPECT_TRUE(is_plain(Axis::kFeed));
}

// In pieces of 47 ms a slide that swings behind its play was random forces.
TEST(Standstill, IsSeenWithAllElseWhereAQuarterWouldBeInTooShortPieces) {
  RecordingSignals signals = shuttle_of_50_s(1, 1700);
  signals.rate_hz = 10.0 * kRateHz;
  EXPECT_EQ(telling_quarter_of(Axis::kFeed, signals).size(), 1U);
  EXPECT_GT(telling_quarter_of(Axis::kSpindle, signals).size(), 1U);
}

// A hole is no rest.
TEST(Standstill, IsNoHole) {
  RecordingSignals signals = shuttle_of_50_s(1, 0);
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  const std::vector<Stretch> whole = telling_quarter_of(Axis::kFeed, signals);
  std::fill_n(speed.begin() + 30000, 300, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(std::ranges::equal(telling_quarter_of(Axis::kFeed, signals), whole, {}, &Stretch::first,
                                 &Stretch::first));
}

TEST(Standstill, IsAllThatSensorsShowWithinTheirNoise) {
  const gap::GapNoise<double> noise{
      .speed_variance = 0.01, .feed_speed_variance = 0.01, .feed_position_variance = 0.01};
  EXPECT_FALSE(stands_still(Axis::kFeed, shuttle(1), noise));
  EXPECT_TRUE(stands_still(Axis::kSpindle, shuttle(1), noise)) << "which was not recorded";
  RecordingSignals resting = shuttle(1);
  for (float& speed : resting.value[index_of(Channel::kFeedSpeed)]) speed -= speed > 0.0F ? 1.0F : -1.0F;
  EXPECT_TRUE(stands_still(Axis::kFeed, resting, noise));
  RecordingSignals elsewhere;
  for (const float speed : resting.value[index_of(Channel::kFeedSpeed)])
    diagnose_test::show(elsewhere, Channel::kFeedPosition, 5.0F + speed);
  EXPECT_TRUE(stands_still(Axis::kFeed, elsewhere, noise)) << "wherever that is";
  RecordingSignals slow = resting;
  for (std::size_t row = 0; row < slow.rows; ++row)
    diagnose_test::show(slow, Channel::kFeedPosition, 0.01 * static_cast<double>(row));
  EXPECT_FALSE(stands_still(Axis::kFeed, slow, noise)) << "so slowly that its position alone tells";
}

/// An axis that is to stay where it is, behind a controller that answers its speed sensor's noise.
RecordingSignals held(double rate_hz, std::size_t rows, const MonitorConfiguration& machine) {
  constexpr double kGainNsM = 3000.0;
  const auto& feed = machine.machine.feed;
  const double kept = std::exp(-feed.viscous_friction_ns_m / feed.mass_kg / rate_hz);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = rate_hz;
  signals.rows = rows;
  double speed_m_s = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double seen_m_s = speed_m_s + machine.sensors[Channel::kFeedSpeed].noise * normal(random);
    const double force_n = -kGainNsM * seen_m_s;
    diagnose_test::show(signals, Channel::kFeedSpeed, seen_m_s);
    diagnose_test::show(signals, Channel::kFeedForce, force_n);
    speed_m_s = kept * speed_m_s + (1.0 - kept) * force_n / feed.viscous_friction_ns_m;
  }
  return signals;
}

// Such noise tells the mass to a hundredth, and the answer was "no gap": of what follows a speed it tells
// next to nothing.
TEST(Standstill, IsNoHealth) {
  const MachineDescription machine = diagnose_test::datasheet(0.0);
  const auto result = diagnose_test::diagnosed(held(2000.0, 12000, machine.configuration), machine);
  EXPECT_EQ(result.verdict, Verdict::kInsufficientExcitation) << diagnose_test::said(result);
  EXPECT_TRUE(result.board_agrees);
  EXPECT_EQ(result.explanation, "nothing moves enough in the recording to tell what a model leaves out");
}

}  // namespace
}  // namespace morepro::host
