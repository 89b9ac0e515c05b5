#include <gtest/gtest.h>

#include <cmath>
#include <utility>

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
  constexpr int kSteps = 20000;
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

/// What friction takes in the halves of an interval is so different that it has all its parts.
Motion<double> in_parts(double speed_m_s, double free_m_s2) {
  const MotionInParts<double> parts(kBrakingPerS, kIntervalS);
  return parts.from(0.0, speed_m_s, -1.0, 1.0, free_m_s2, [](double acting_s, double v) {
    return friction_step(v, kSideM_s, kFrictionM_s2 * acting_s);
  });
}

// A part is a sixteenth of the step: what friction takes in half of one is the most that a turn within it is
// wrong by.
TEST(BrakedMotion, TurnsSticksAndBreaksAwayWithinAStep) {
  constexpr double kOfAPart = kFrictionM_s2 * kIntervalS / 16.0;
  for (const double speed : {-5.0e-3, -1.0e-3, -1.0e-4, 0.0, 3.0e-4, 2.0e-3, 2.0e-2})
    for (const double free : {-20.0, -5.0, -2.0, 0.0, 2.6, 2.8, 4.0, 12.0}) {
      const auto motion = in_parts(speed, free);
      const PlaceAndSpeed truth = way_of(speed, free);
      EXPECT_NEAR(motion.speed_m_s, truth.speed_m_s, 0.5 * kOfAPart) << speed << " " << free;
      EXPECT_NEAR(motion.position_m, truth.position_m, 0.5 * kOfAPart * kIntervalS) << speed << " " << free;
    }
}

TEST(BrakedMotion, KnowsWhatIsLeftOfASmallDifference) {
  constexpr double kSpeed = 1.0e-8, kRate = 1.0e-5;
  for (const double speed : {-2.0e-3, 1.0e-4, 5.0e-3})
    for (const double free : {-12.0, 1.0, 4.0}) {
      const auto here = in_parts(speed, free);
      const auto faster = in_parts(speed + kSpeed, free), slower = in_parts(speed - kSpeed, free);
      EXPECT_NEAR(here.by_state.a11, (faster.speed_m_s - slower.speed_m_s) / (2.0 * kSpeed), 1.0e-4);
      EXPECT_NEAR(here.by_state.a01, (faster.position_m - slower.position_m) / (2.0 * kSpeed), 1.0e-7);
      const auto more = in_parts(speed, free + kRate), less = in_parts(speed, free - kRate);
      EXPECT_NEAR(here.by_rate.a11, (more.speed_m_s - less.speed_m_s) / (2.0 * kRate), 1.0e-7);
      EXPECT_NEAR(here.by_rate.a01, (more.position_m - less.position_m) / (2.0 * kRate), 1.0e-10);
    }
}

// Where a wide side is nearly left behind friction grows by 3 % within the step: four parts are right to a
// thousandth of what it takes.
TEST(BrakedMotion, HasFewerPartsWhereFrictionHardlyChanges) {
  constexpr double kWideM_s = 2.0e-3, kSpeed = 5.0e-3, kFree = 5.0;
  constexpr double kThousandth = 1.0e-3 * kFrictionM_s2 * kIntervalS;
  const MotionInParts<double> interval(kBrakingPerS, kIntervalS);
  const double truth = way_of(kSpeed, kFree, kWideM_s).speed_m_s;
  for (const auto& [last, parts] : {std::pair(-1.03, 4), std::pair(-1.04, 16)}) {
    int rubs = 0;
    const auto motion = interval.from(0.0, kSpeed, -1.0, last, kFree, [&rubs](double acting_s, double v) {
      ++rubs;
      return friction_step(v, kWideM_s, kFrictionM_s2 * acting_s);
    });
    EXPECT_EQ(rubs, parts + 1);
    EXPECT_NEAR(motion.speed_m_s, truth, kThousandth);
  }
}

// A quarter of few parts is right only where friction changes still less.
TEST(BrakedMotion, HasAllPartsWhereAQuarterOfThemIsNotEnough) {
  const MotionInParts<double> interval(kBrakingPerS, 0.5 * kIntervalS);
  for (const auto& [last, parts] : {std::pair(-1.007, 2), std::pair(-1.009, 8)}) {
    int rubs = 0;
    const auto motion = interval.from(0.0, 5.0e-3, -1.0, last, 5.0, [&rubs](double acting_s, double v) {
      ++rubs;
      return friction_step(v, kSideM_s, kFrictionM_s2 * acting_s);
    });
    EXPECT_EQ(rubs, parts + 1) << motion.speed_m_s;
  }
}

// At 500 Hz, too, a part is as short: with sixteen of 0.13 ms 9 % of the noise's power were left of 8 N, and
// their error was three times as large.
TEST(BrakedMotion, HasPartsAsShortInALongInterval) {
  const MotionInParts<double> interval(kBrakingPerS, 2.0 * kIntervalS);
  int rubs = 0;
  const auto motion = interval.from(0.0, 5.0e-3, -1.0, 1.0, 5.0, [&rubs](double acting_s, double v) {
    ++rubs;
    return friction_step(v, kSideM_s, kFrictionM_s2 * acting_s);
  });
  EXPECT_EQ(rubs, 32 + 1) << motion.speed_m_s;
}

// Halves of an interval's friction each took (1 + exp(-b h)) / 2 of it, b h = 0.07 here: 3 N came back as
// 3.1 N at 1 kHz.
TEST(BrakedMotion, AFrictionThatDoesNotChangeIsExactWithoutParts) {
  const double kept = std::exp(-kBrakingPerS * kIntervalS);
  const double integral_s = (1.0 - kept) / kBrakingPerS;
  const double half_s = half_of(integral_s, kept);
  EXPECT_NEAR(kept * half_s + half_s, integral_s, 1.0e-15);
  EXPECT_FALSE(MotionInParts<double>(kBrakingPerS, kIntervalS).is_needed(-1.0e-3, -1.0e-3));
}

TEST(BrakedMotion, PartsAreForLongIntervalsInWhichFrictionChanges) {
  const MotionInParts<double> slow(kBrakingPerS, kIntervalS), fast(kBrakingPerS, 5.0e-5);
  EXPECT_TRUE(slow.is_needed(-1.0e-3, 1.0e-3)) << "it turned";
  EXPECT_TRUE(slow.is_needed(0.0, -1.0e-3)) << "it broke away";
  EXPECT_FALSE(slow.is_needed(0.0, 0.0)) << "there is no friction";
  EXPECT_FALSE(fast.is_needed(-1.0e-3, 1.0e-3));
}

}  // namespace
}  // namespace morepro::gap
