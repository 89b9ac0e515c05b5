#include <gtest/gtest.h>

#include <cmath>

#include "lib/gap/braked_motion.hpp"

namespace morepro::gap {
namespace {

constexpr double kIntervalS = 1.0e-3;
constexpr double kBrakingPerS = 66.0;
constexpr double kFrictionM_s2 = 2.7;
constexpr double kSideM_s = 2.0e-4;

struct PlaceAndSpeed {
  double position_m;
  double speed_m_s;
};

/// The same axis in small steps of second order.
PlaceAndSpeed way_of(double speed_m_s, double free_m_s2, double side_m_s = kSideM_s) {
  constexpr int kSteps = 4000;
  constexpr double kS = kIntervalS / kSteps;
  const auto rate = [free_m_s2, side_m_s](double v) {
    return free_m_s2 - kBrakingPerS * v - kFrictionM_s2 * std::tanh(v / side_m_s);
  };
  PlaceAndSpeed place{0.0, speed_m_s};
  for (int i = 0; i < kSteps; ++i) {
    const double middle = place.speed_m_s + 0.5 * kS * rate(place.speed_m_s);
    place.position_m += kS * middle;
    place.speed_m_s += kS * rate(middle);
  }
  return place;
}

struct Unwatched {
  static void begin() {}
  template <class Real>
  static void step(const math::PhiFunctions<Real>&, Real) {}
};

/// One interval, and how often friction was asked for.
template <class Real = double>
Motion<Real> interval_of(Real speed_m_s, Real free_m_s2, Real side_m_s = Real(kSideM_s),
                         int* asked = nullptr) {
  const BrakedMotion<Real> braked{static_cast<Real>(kBrakingPerS), static_cast<Real>(kIntervalS)};
  const ActingFriction<Real> friction{
      .size = Real(kFrictionM_s2), .yield = Real(1), .per_width = Real(1) / side_m_s};
  Motion<Real> motion;
  EXPECT_TRUE(braked.move(
      Real(0), speed_m_s, free_m_s2, side_m_s,
      [&](Real v) {
        if (asked != nullptr) ++*asked;
        return friction.at(v);
      },
      Unwatched{}, motion));
  return motion;
}

// Slow and fast beside the width of the side, and forces that hold it, let it creep, turn it or break it
// away.
constexpr double kSpeeds[] = {-2.0e-2, -5.0e-3, -1.0e-3, -1.0e-4, 0.0, 3.0e-4, 2.0e-3, 2.0e-2};
constexpr double kForces[] = {-20.0, -5.0, -2.0, 0.0, 2.6, 2.8, 4.0, 12.0};

// Two thousandths of the width: each step may be wrong by less than one.
TEST(BrakedMotion, TurnsSticksAndBreaksAwayWithinAnInterval) {
  constexpr double kOfWidth = 2.0e-3 * kSideM_s;
  for (const double speed : kSpeeds)
    for (const double free : kForces) {
      const auto motion = interval_of(speed, free);
      const PlaceAndSpeed truth = way_of(speed, free);
      EXPECT_NEAR(motion.speed_m_s, truth.speed_m_s, kOfWidth) << speed << " " << free;
      EXPECT_NEAR(motion.position_m, truth.position_m, kOfWidth * kIntervalS) << speed << " " << free;
    }
}

// Root mean square over slides that turn, stick and break away: 1.4e-4 of what a width moves, 1.7e-4 without
// what a step's rest does to the position.
TEST(BrakedMotion, MovesAsFarAsItDoes) {
  double squares = 0.0;
  int count = 0;
  for (double speed = -5.0 * kSideM_s; speed < 5.0 * kSideM_s; speed += 0.115 * kSideM_s)
    for (const double free : kForces) {
      const double error_m = interval_of(speed, free).position_m - way_of(speed, free).position_m;
      squares += error_m * error_m;
      ++count;
    }
  EXPECT_LT(std::sqrt(squares / count), 1.55e-4 * kSideM_s * kIntervalS);
}

// Halves of friction around an interval are wrong by some hundredths of the width in every interval that an
// axis creeps against friction: 10 um in a second of a machine at 10 kHz, which a position tells.
TEST(BrakedMotion, CreepsAsFastAsItDoes) {
  constexpr double kFree = 2.0;
  double steady = kSideM_s * std::atanh(kFree / kFrictionM_s2);  // but for viscous friction
  for (int i = 0; i < 10; ++i) steady = way_of(steady, kFree).speed_m_s;
  const auto motion = interval_of(steady, kFree);
  const PlaceAndSpeed truth = way_of(steady, kFree);
  EXPECT_NEAR(motion.position_m, truth.position_m, 1.0e-6 * steady * kIntervalS);
  EXPECT_NEAR(motion.speed_m_s, truth.speed_m_s, 1.0e-6 * steady);
}

// The mean of the slopes at both ends of a step stands for the slopes between: 1 % of what there is.
TEST(BrakedMotion, KnowsWhatIsLeftOfASmallDifference) {
  constexpr double kSpeed = 1.0e-7, kRate = 1.0e-4;
  for (const double speed : kSpeeds)
    for (const double free : kForces) {
      const auto here = interval_of(speed, free);
      const auto faster = way_of(speed + kSpeed, free), slower = way_of(speed - kSpeed, free);
      EXPECT_NEAR(here.by_state.a11, (faster.speed_m_s - slower.speed_m_s) / (2.0 * kSpeed), 0.01)
          << speed << " " << free;
      EXPECT_NEAR(here.by_state.a01, (faster.position_m - slower.position_m) / (2.0 * kSpeed),
                  0.01 * kIntervalS)
          << speed << " " << free;
      const auto more = way_of(speed, free + kRate), less = way_of(speed, free - kRate);
      EXPECT_NEAR(here.by_rate.a11, (more.speed_m_s - less.speed_m_s) / (2.0 * kRate), 0.01 * kIntervalS)
          << speed << " " << free;
      EXPECT_NEAR(here.by_rate.a01, (more.position_m - less.position_m) / (2.0 * kRate),
                  0.01 * kIntervalS * kIntervalS)
          << speed << " " << free;
    }
}

// A slide that turns: friction's mean over the fine steps.
TEST(BrakedMotion, TellsWhatFrictionTook) {
  constexpr int kParts = 1000;
  const double speed = -1.0e-3, free = 2.8;
  double rubbed = 0.0, v = speed;
  for (int i = 0; i < kParts; ++i) {
    const double rate = free - kBrakingPerS * v - kFrictionM_s2 * std::tanh(v / kSideM_s);
    const double middle = v + 0.5 * kIntervalS / kParts * rate;
    rubbed -= kIntervalS / kParts * kFrictionM_s2 * std::tanh(middle / kSideM_s);
    v += kIntervalS / kParts * (free - kBrakingPerS * middle - kFrictionM_s2 * std::tanh(middle / kSideM_s));
  }
  const auto motion = interval_of(speed, free);
  EXPECT_NEAR(motion.rubbed_m_s, rubbed, 2.0e-3 * kSideM_s);
  EXPECT_EQ(motion.rubbing_s, kIntervalS);
}

// The tangent of friction at the first speed meets it again on the other side: a whole interval seemed to be
// right there, and ended at 44 widths instead of 26.
TEST(BrakedMotion, IsNotDeceivedWhereATangentMeetsFrictionAgain) {
  for (double speed = -3.0 * kSideM_s; speed < 0.0; speed += 0.01 * kSideM_s)
    for (const double free : {3.5, 5.0, 5.38, 6.5, 9.0}) {
      const auto motion = interval_of(speed, free);
      EXPECT_NEAR(motion.speed_m_s, way_of(speed, free).speed_m_s, 5.0e-3 * kSideM_s) << speed << " " << free;
    }
}

// What has come to rest takes one step, two looks at friction; what turns takes some, around zero.
TEST(BrakedMotion, TakesAsManyStepsAsFrictionChanges) {
  double steady = 0.0;
  for (int i = 0; i < 10; ++i) steady = way_of(steady, 2.0).speed_m_s;
  int resting = 0, turning = 0;
  (void)interval_of(steady, 2.0, kSideM_s, &resting);
  (void)interval_of(-1.0e-3, 12.0, kSideM_s, &turning);
  EXPECT_EQ(resting, 2);
  EXPECT_GT(turning, 4);
  EXPECT_LT(turning, 60);
}

// A side that no interval resolves, of a friction that is a thousand times stiffer: it comes to rest, in a
// bounded time.
TEST(BrakedMotion, HoldsAnAxisWithASideAsSharpAsAKnife) {
  constexpr double kSharp = 2.0e-8;
  for (const double speed : {-1.0e-3, 1.0e-4, 2.0e-3})
    for (const double free : {-2.0, 0.0, 2.6}) {
      int asked = 0;
      const auto motion = interval_of(speed, free, kSharp, &asked);
      const PlaceAndSpeed truth = way_of(speed, free, 1.0e-6);
      EXPECT_NEAR(motion.speed_m_s, truth.speed_m_s, 5.0e-6) << speed << " " << free;
      EXPECT_NEAR(motion.position_m, truth.position_m, 5.0e-9) << speed << " " << free;
      EXPECT_LE(asked, 120);
    }
}

// As far as float tells a speed: to a hundredth of the width.
TEST(BrakedMotion, IsNearlyTheSameInFloat) {
  constexpr double kOfWidth = 1.0e-2 * kSideM_s;
  for (const double speed : kSpeeds)
    for (const double free : kForces) {
      const auto exact = interval_of(speed, free);
      const auto motion = interval_of(static_cast<float>(speed), static_cast<float>(free));
      EXPECT_NEAR(static_cast<double>(motion.speed_m_s), exact.speed_m_s, kOfWidth);
      EXPECT_NEAR(static_cast<double>(motion.position_m), exact.position_m, kOfWidth * kIntervalS);
      EXPECT_NEAR(static_cast<double>(motion.by_state.a11), exact.by_state.a11, 1.0e-2);
    }
}

// Halves of it each took (1 + exp(-b h)) / 2, b h = 0.07 here: 3 N came back as 3.1 N at 1 kHz. With halves
// that take it all the position was still wrong by 15 nm, which cost two units of deviance per row.
TEST(BrakedMotion, IsExactForAFrictionThatDoesNotChange) {
  constexpr double kSpeed = 2.0e-2, kFree = -1.0;
  const double kept = std::exp(-kBrakingPerS * kIntervalS);
  const double integral_s = (1.0 - kept) / kBrakingPerS;
  const double steady = (kFree - kFrictionM_s2) / kBrakingPerS;
  const auto motion = interval_of(kSpeed, kFree);
  EXPECT_NEAR(motion.speed_m_s, steady + (kSpeed - steady) * kept, 1.0e-15);
  EXPECT_NEAR(motion.position_m, steady * kIntervalS + (kSpeed - steady) * integral_s, 1.0e-15);
  const double half_s = half_of(integral_s, kept);
  EXPECT_NEAR(kept * half_s + half_s, integral_s, 1.0e-15);
}

TEST(BrakedMotion, IsForIntervalsThatTellWhenAnAxisTurned) {
  EXPECT_TRUE(BrakedMotion<double>(kBrakingPerS, 4.0e-3).tells_turns());
  EXPECT_FALSE(BrakedMotion<double>(kBrakingPerS, 5.0e-3).tells_turns());
}

}  // namespace
}  // namespace morepro::gap
