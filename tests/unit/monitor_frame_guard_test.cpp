#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "lib/monitor/frame_guard.hpp"

namespace morepro {
namespace {

constexpr std::uint32_t kPeriod_us = 100;

SensorFrame frame(std::uint32_t sequence, std::uint32_t time_us) {
  SensorFrame f;
  f.sequence = sequence;
  f.time_us = time_us;
  f.set(Channel::kArmatureVoltage, 48.0F);
  f.set(Channel::kSpindleSpeed, 100.0F + 0.01F * static_cast<float>(sequence % 97));
  return f;
}

SensorFrame frame(std::uint32_t sequence) { return frame(sequence, sequence * kPeriod_us); }

bool has(const GuardedFrame& result, FrameFlag flag) { return (result.flags & bits_of(flag)) != 0; }

TEST(FrameGuard, StartsWithTheFirstFrame) {
  FrameGuard guard(1.0e4);
  const auto result = guard.check(frame(7));
  EXPECT_TRUE(result.is_accepted);
  EXPECT_TRUE(result.is_restart);
  EXPECT_EQ(result.missing, 0U);
}

TEST(FrameGuard, IgnoresDuplicatesAndStragglers) {
  FrameGuard guard(1.0e4);
  (void)guard.check(frame(1));
  (void)guard.check(frame(2));
  const auto duplicate = guard.check(frame(2));
  EXPECT_FALSE(duplicate.is_accepted);
  EXPECT_TRUE(has(duplicate, FrameFlag::kDuplicate));
  const auto old = guard.check(frame(1));
  EXPECT_FALSE(old.is_accepted);
  EXPECT_TRUE(has(old, FrameFlag::kOld));
  const auto next = guard.check(frame(3));
  EXPECT_TRUE(next.is_accepted);
  EXPECT_EQ(next.periods, 1U);
}

TEST(FrameGuard, CountsAndBridgesShortGaps) {
  FrameGuard guard(1.0e4);
  (void)guard.check(frame(1));
  const auto result = guard.check(frame(4));
  EXPECT_TRUE(result.is_accepted);
  EXPECT_FALSE(result.is_restart);
  EXPECT_EQ(result.periods, 3U);
  EXPECT_EQ(result.missing, 2U);
  EXPECT_TRUE(has(result, FrameFlag::kMissingBefore));
}

TEST(FrameGuard, StartsAgainAfterALongGapAndAfterATimeJump) {
  FrameGuard guard(1.0e4);
  (void)guard.check(frame(1));
  const auto gap = guard.check(frame(2 + FrameGuard::kLongestGap));
  EXPECT_TRUE(gap.is_accepted && gap.is_restart && has(gap, FrameFlag::kTimeJump));
  const auto jump = guard.check(frame(3 + FrameGuard::kLongestGap, 50'000'000));
  EXPECT_TRUE(jump.is_accepted && jump.is_restart && has(jump, FrameFlag::kTimeJump));
}

TEST(FrameGuard, RefusesTimeThatRunsBackwards) {
  FrameGuard guard(1.0e4);
  (void)guard.check(frame(10, 5000));
  EXPECT_FALSE(guard.check(frame(11, 5000)).is_accepted) << "time stands still";
  EXPECT_FALSE(guard.check(frame(12, 4000)).is_accepted) << "time runs backwards";
  EXPECT_TRUE(guard.check(frame(13, 5100)).is_accepted);
}

TEST(FrameGuard, FollowsASenderThatStartedAgain) {
  FrameGuard guard(1.0e4);
  (void)guard.check(frame(100000));
  for (std::uint32_t k = 1; k < 20; ++k) ASSERT_FALSE(guard.check(frame(k)).is_accepted) << k;
  const auto result = guard.check(frame(20));
  EXPECT_TRUE(result.is_accepted && result.is_restart);
  EXPECT_TRUE(has(result, FrameFlag::kSequenceReset));
}

TEST(FrameGuard, DoesNotNoticeTheWrapOfTimeAndSequence) {
  FrameGuard guard(1.0e4);
  std::uint32_t sequence = std::numeric_limits<std::uint32_t>::max() - 5,
                time_us = std::numeric_limits<std::uint32_t>::max() - 550;
  (void)guard.check(frame(sequence, time_us));
  for (int k = 0; k < 20; ++k) {
    const auto result = guard.check(frame(++sequence, time_us += kPeriod_us));
    ASSERT_TRUE(result.is_accepted && !result.is_restart) << k;
    ASSERT_EQ(result.periods, 1U);
    ASSERT_EQ(result.missing, 0U);
  }
}

TEST(FrameGuard, DropsValuesThatNoSensorCanGive) {
  const float quiet = std::numeric_limits<float>::quiet_NaN(),
              signalling = std::numeric_limits<float>::signaling_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    for (float bad : {quiet, signalling, infinity, -infinity, kChannels[i].highest * 2.0F + 1.0F,
                      kChannels[i].lowest * 2.0F - 1.0F}) {
      FrameGuard guard(1.0e4);
      SensorFrame f = frame(1);
      const auto channel = static_cast<Channel>(i);
      f.set(channel, bad);
      const auto result = guard.check(f);
      EXPECT_TRUE(result.is_accepted);
      EXPECT_FALSE(result.frame.has(channel)) << kChannels[i].column;
      EXPECT_EQ(result.rejected, bit_of(channel));
    }
  }
}

/// Feeds `frames` speeds made by `value(k)`; the frame at which the guard first called the sensor stuck, -1:
/// never.
template <class Value>
int first_stuck(int frames, float voltage, Value value) {
  FrameGuard guard(1.0e4);
  for (int k = 0; k < frames; ++k) {
    SensorFrame f = frame(static_cast<std::uint32_t>(k));
    f.set(Channel::kArmatureVoltage, voltage);
    f.set(Channel::kSpindleSpeed, value(k));
    if (has(guard.check(f), FrameFlag::kStuck)) return k;
  }
  return -1;
}

TEST(FrameGuard, FindsAStuckSensorWithin100Frames) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(100.0F, 1.0F);
  const int found = first_stuck(2000, 48.0F, [&](int k) { return k < 1000 ? noise(random) : 101.5F; });
  EXPECT_GT(found, 1000);
  EXPECT_LE(found, 1100);
}

TEST(FrameGuard, DoesNotSuspectACoarseSensor) {
  EXPECT_EQ(first_stuck(20000, 12.0F, [](int k) { return static_cast<float>(k / 60); }), -1);
}

TEST(FrameGuard, DoesNotSuspectAMachineThatStandsStill) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(100.0F, 1.0F);
  EXPECT_EQ(first_stuck(3000, 0.0F, [&](int k) { return k < 1000 ? noise(random) : 0.0F; }), -1);
}

}  // namespace
}  // namespace morepro
