#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "lib/gap/repeated_frames.hpp"

namespace morepro::gap {
namespace {

/// Sensors in steps of one with noise of `noise` steps, that follow a motion of `steps_per_frame` or rest.
struct Machine {
  int sensors = 2;
  double noise = 1.0;
  double steps_per_frame = 0.0;
  int rests_every = 0;      ///< frames of motion, and as many of rest
  double lost_share = 0.0;  ///< of its frames, one to three at once
  double swing = 0.0;       ///< steps, within `period` frames
  int period = 100;
  int frames = 100000;
};

RepeatedFrames<double> seen_of(const Machine& machine, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  RepeatedFrames<double> frames;
  std::array<double, SameSensors::kMost> before{};
  std::array<double, SameSensors::kMost> earlier{};
  double place = 0.0;
  int lost = 0;
  for (int i = 0; i < machine.frames; ++i) {
    const bool is_at_rest = machine.rests_every > 0 && i / machine.rests_every % 2 == 1;
    if (!is_at_rest) place += machine.steps_per_frame;
    if (machine.swing > 0.0) place = machine.swing * std::sin(2.0 * std::numbers::pi * i / machine.period);
    if (lost > 0)
      --lost;
    else if (uniform(random) < 0.5 * machine.lost_share)
      lost = 1 + static_cast<int>(3.0 * uniform(random));
    SameSensors same;
    for (int k = 0; k < machine.sensors; ++k) {
      const auto sensor = static_cast<std::size_t>(k);
      const double shown =
          lost > 0 ? before[sensor] : std::round((1.0 + k) * place + machine.noise * normal(random));
      same.add(sensor, shown == before[sensor]);
      same.is_as_before_last &= shown == earlier[sensor];
      earlier[sensor] = std::exchange(before[sensor], shown);
    }
    frames.see(same);
  }
  frames.end();
  return frames;
}

TEST(RepeatedFrames, ChanceMakesNone) {
  for (const int sensors : {1, 2, 3, 4})
    for (const double noise : {0.7, 1.0, 3.0})
      for (const double steps : {0.0, 0.3, 2.0})
        EXPECT_EQ(seen_of({.sensors = sensors, .noise = noise, .steps_per_frame = steps}).lost_share(), 0.0)
            << sensors << " sensors, noise " << noise << ", " << steps << " steps per frame";
}

// In motion to four standard deviations of their count. Of a machine at rest, whose sensors are the same in
// 28 of 100 frames each, to a fifth: frames beside which many were lost look like a rest.
TEST(RepeatedFrames, AreCountedBesideChance) {
  for (const int sensors : {2, 3, 4})
    for (const double steps : {0.0, 2.0}) {
      if (sensors == 2 && steps == 0.0) continue;
      const Machine machine{.sensors = sensors, .steps_per_frame = steps, .lost_share = 0.1};
      // A run of two frames on average begins in 0.5 of the share of those in which none is going on.
      const double lost = machine.lost_share / (1.0 + machine.lost_share);
      EXPECT_NEAR(seen_of(machine).lost_share(), lost,
                  steps == 0.0 ? 0.2 * lost : 4.0 * std::sqrt(2.0 * lost / machine.frames))
          << sensors << " sensors, " << steps << " steps per frame";
    }
}

// A recording in which every sample is shown twice.
TEST(RepeatedFrames, AreHalfOfAllOfASlowerSource) {
  RepeatedFrames<double> frames;
  for (int i = 0; i < 1000; ++i) {
    SameSensors same;
    same.add(0, i % 2 == 1);
    same.add(1, i % 2 == 1);
    same.is_as_before_last = false;
    frames.see(same);
  }
  EXPECT_NEAR(frames.lost_share(), 0.5, 0.01);
}

// Where a machine rests for a part of the time all sensors are the same together more often than chance
// makes.
TEST(RepeatedFrames, AreNoneAtTheEdgesOfARest) {
  for (const int sensors : {2, 3, 4})
    for (const double noise : {0.3, 0.5, 1.0})
      for (const int every : {5, 8, 12, 20, 50, 100, 200, 500})
        EXPECT_EQ(seen_of({.sensors = sensors, .noise = noise, .steps_per_frame = 5.0, .rests_every = every})
                      .lost_share(),
                  0.0)
            << sensors << " sensors, noise " << noise << ", " << every << " frames";
}

// Two sensors that swing in phase are the same together within a frame or two of where they turn.
TEST(RepeatedFrames, AreNoneWhereAMotionTurns) {
  EXPECT_EQ(seen_of({.noise = 1.0, .swing = 100.0, .period = 63}).lost_share(), 0.0);
  EXPECT_EQ(seen_of({.noise = 1.0, .swing = 100.0, .period = 102}).lost_share(), 0.0);
  EXPECT_EQ(seen_of({.noise = 1.0, .swing = 300.0, .period = 203}).lost_share(), 0.0);
  EXPECT_EQ(seen_of({.noise = 0.7, .swing = 300.0, .period = 203}).lost_share(), 0.0);
  EXPECT_GT(seen_of({.noise = 1.0, .lost_share = 0.05, .swing = 100.0, .period = 102}).lost_share(), 0.03);
}

TEST(RepeatedFrames, AreNoneOfAMachineThatStandsStillForLong) {
  for (const int every : {12, 100, 500})
    EXPECT_EQ(seen_of({.noise = 0.0, .steps_per_frame = 5.0, .rests_every = every}).lost_share(), 0.0)
        << every;
}

TEST(RepeatedFrames, OfOneSensorNobodyKnows) {
  EXPECT_EQ(seen_of({.sensors = 1, .lost_share = 0.05}).lost_share(), 0.0);
}

TEST(RepeatedFrames, MergeAndFade) {
  const Machine machine{.steps_per_frame = 2.0, .lost_share = 0.02};
  RepeatedFrames<double> both = seen_of(machine);
  const double first = both.lost_share();
  const double second = seen_of({.steps_per_frame = 2.0, .lost_share = 0.06}, 2).lost_share();
  both.merge(seen_of({.steps_per_frame = 2.0, .lost_share = 0.06}, 2));
  // Frames that look like a rest do not count, one in a hundred of them.
  EXPECT_NEAR(both.lost_share(), 0.5 * (first + second), 0.01 * first);
  const double before = both.lost_share();
  both.fade();
  EXPECT_DOUBLE_EQ(both.lost_share(), before);
}

TEST(SameSensors, ThatAreJoinedAreOneWitness) {
  SameSensors sensors;
  sensors.add(2, true);
  sensors.add(3, true);
  EXPECT_TRUE(sensors.are_all());
  sensors.join(2, 3);
  EXPECT_FALSE(sensors.are_all()) << "one alone may stand still";
  sensors.add(0, true);
  EXPECT_TRUE(sensors.are_all());
  SameSensors other;
  other.add(0, true);
  other.add(2, true);
  other.add(3, false);
  other.join(2, 3);
  EXPECT_EQ(other.measured, 0b101);
  EXPECT_EQ(other.same, 0b001);
  SameSensors alone;
  alone.add(3, true);
  alone.join(2, 3);
  EXPECT_EQ(alone.measured, 0b1000) << "there is nothing to join it with";
}

}  // namespace
}  // namespace morepro::gap
