#include <gtest/gtest.h>

#include "lib/gap/effect_memory.hpp"

namespace morepro::gap {
namespace {

constexpr double kWidthM = 1.0e-4;
constexpr double kStepS = 1.0e-4;

double crossed(Play<double>& play, double acceleration_m_s2) {
  return play(acceleration_m_s2, acceleration_m_s2, kWidthM, kStepS);
}

/// Steps until drive and slide have met, at most a thousand.
int steps_to_the_end(Play<double>& play, double acceleration_m_s2) {
  double apart_m_s = 0.0;
  int steps = 0;
  do {
    apart_m_s += crossed(play, acceleration_m_s2);
    ++steps;
  } while (apart_m_s != 0.0 && steps < 1000);
  return steps;
}

TEST(Play, IsCrossedInTheTimeOfFreeFall) {
  Play<double> play;
  // Half of the width from the middle, then all of it: s = a t^2 / 2, t = sqrt(w / a), sqrt(2 w / a).
  EXPECT_NEAR(steps_to_the_end(play, 10.0), 31.6, 1.0);
  EXPECT_NEAR(steps_to_the_end(play, -10.0), 44.7, 1.0);
}

TEST(Play, HoldsDriveAndSlideTogetherAtItsEnd) {
  Play<double> play;
  steps_to_the_end(play, 10.0);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(crossed(play, 10.0), 0.0);
  EXPECT_LT(crossed(play, -10.0), 0.0);
}

TEST(Play, GivesBackWhatTheDriveGained) {
  Play<double> play;
  double sum = 0.0;
  for (int k = 0; k < 5000; ++k) sum += crossed(play, k / 500 % 2 == 0 ? 20.0 : -20.0);
  for (int k = 0; k < 200; ++k) sum += crossed(play, 20.0);
  EXPECT_NEAR(sum, 0.0, 1e-15);  // one mass again: momentum is kept, whatever the crossings
}

TEST(Play, LosesAPartOfTheGainWithTheWhole) {
  Play<double> play;
  double part = 0.0;
  for (int k = 0; k < 20; ++k) part += play(10.0, 4.0, kWidthM, kStepS);
  EXPECT_NEAR(part, 20 * 4.0 * kStepS, 1e-15);
  for (int k = 0; k < 20; ++k) part += play(10.0, 4.0, kWidthM, kStepS);
  EXPECT_NEAR(part, 0.0, 1e-15);
}

TEST(Play, OfNoWidthIsNone) {
  Play<double> play;
  for (int k = 0; k < 100; ++k) EXPECT_EQ(play(k % 2 == 0 ? 5.0 : -5.0, 5.0, 0.0, kStepS), 0.0);
}

}  // namespace
}  // namespace morepro::gap
