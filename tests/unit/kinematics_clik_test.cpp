#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/morepro_machine.hpp"
#include "lib/kinematics/path.hpp"
#include "lib/kinematics/pose_search.hpp"
#include "tests/support/chains.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro::kinematics {
namespace {

constexpr double kPeriodS = 1.0e-3;

ClikError status_of(double gain_per_s, double period_s, int rows = kRollRows) {
  return ClikSettings{gain_per_s, period_s, static_cast<TaskRows>(rows)}.validate();
}

TEST(KinematicsClik, AGainOutsideItsStableRangeIsRefused) {
  EXPECT_EQ(status_of(50.0, kPeriodS), ClikError::kNone);
  EXPECT_EQ(status_of(1999.9, kPeriodS), ClikError::kNone);
  for (const double gain :
       {2000.0, 2000.1, 0.0, -1.0, test::kNan<double>, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(status_of(gain, kPeriodS), ClikError::kGain) << gain;
}

TEST(KinematicsClik, ImpossiblePeriodsAndTasksAreRefused) {
  for (const double period : {0.0, -1.0, test::kNan<double>, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(status_of(50.0, period), ClikError::kPeriod) << period;
  EXPECT_EQ(status_of(50.0, kPeriodS, 0), ClikError::kRows);
  EXPECT_EQ(status_of(50.0, kPeriodS, 64), ClikError::kRows);
}

/// Errors after each of some steps towards a pose that stands still, 0.1 m away.
std::array<double, 40> errors_with(double gain_per_s) {
  Clik<double> clik(Chain<double>(morepro_table()), {gain_per_s, kPeriodS}, {});
  ToolState<double> wanted;
  wanted.position_m = {0.37, 0.1, 0.4};
  std::array<double, 40> errors{};
  for (double& error : errors) error = clik.step(wanted).error(0);
  return errors;
}

TEST(KinematicsClik, TheErrorShrinksByOneMinusGainTimesPeriod) {
  for (const double gain : {50.0, 900.0, 1500.0, 1990.0}) {
    const auto errors = errors_with(gain);
    for (std::size_t k = 1; k < errors.size(); ++k)
      EXPECT_NEAR(errors[k], errors[k - 1] * (1.0 - gain * kPeriodS), 1.0e-15) << gain;
  }
}

TEST(KinematicsClik, BeyondTwoOverThePeriodTheErrorGrows) {
  const auto errors = errors_with(2010.0);
  EXPECT_GT(std::abs(errors.back()), 1.3 * std::abs(errors.front()));
}

Path<double, 2> straight_path() {
  Path<double, 2> path;
  EXPECT_EQ(path.add({{0.3, 0.1, 0.4}, {0.0, 0.0, 0.0}}, 0.0), PathError::kNone);
  EXPECT_EQ(path.add({{0.5, 0.2, 0.3}, {0.6, 0.0, 0.0}}, 2.0), PathError::kNone);
  return path;
}

JointVector<double> start_of(const Path<double, 2>& path) {
  return inverse_of(MachineGeometry{}, RollPose<double>{path.at(0.0).position_m, 0.0});
}

TEST(KinematicsClik, TheResidualIsPeriodTimesAccelerationOverTwiceTheGain) {
  const auto path = straight_path();
  for (const double gain : {30.0, 50.0, 400.0}) {
    Clik<double> clik(Chain<double>(morepro_table()), {gain, kPeriodS}, start_of(path));
    // 0.6 s are within the ramp and 18 time constants of the slowest: what the start left is 1e-8 of it.
    for (int k = 0; k < 600; ++k) clik.step(path.at(k * kPeriodS));
    const Twist<double> residual = clik.step(path.at(0.6)).error;
    const Twist<double> predicted = path.at(0.6).acceleration * kPeriodS / (2.0 * gain);
    EXPECT_LE((residual - predicted).norm(), 0.01 * predicted.norm()) << gain;
  }
}

TEST(KinematicsClik, RatesAndAccelerationsAreThoseOfTheClosedFormOnceTheErrorIsGone) {
  const auto path = straight_path();
  Clik<double> clik(Chain<double>(morepro_table()), {.gain_per_s = 50.0, .period_s = 1.0e-4}, start_of(path));
  for (int k = 0; k < 5000; ++k) clik.step(path.at(k * 1.0e-4));
  const ToolState<double> wanted = path.at(0.5);
  const ClikStep<double> step = clik.solve(wanted);
  const auto reached = clik.acceleration(wanted);
  const auto rate = inverse_rates_of<double>(wanted.speed.head<3>(), wanted.speed(3));
  const auto acceleration = inverse_rates_of<double>(wanted.acceleration.head<3>(), wanted.acceleration(3));
  for (std::size_t i = 0; i < 4; ++i) {
    // Half a period of acceleration lies between an explicit step and the middle of it.
    EXPECT_NEAR(step.rate[i], rate[i], 0.6 * 1.0e-4 * std::abs(acceleration[i]) + 1.0e-12);
    EXPECT_NEAR(reached[i], acceleration[i], 0.003 * std::abs(acceleration[i]) + 1.0e-9);
  }
}

/// A path of the six-joint arm that turns the tool about all axes.
Path<double, 3> arm_path() {
  Path<double, 3> path;
  EXPECT_EQ(path.add({{0.45, 0.1, 0.75}, {0.1, 0.5, 0.2}}, 0.0), PathError::kNone);
  EXPECT_EQ(path.add({{0.35, -0.2, 0.6}, {-0.4, 0.8, -0.3}}, 2.0), PathError::kNone);
  EXPECT_EQ(path.add({{0.5, 0.0, 0.5}, {0.5, 1.1, 0.0}}, 2.0), PathError::kNone);
  return path;
}

TEST(KinematicsClik, AnyChainFollowsPositionAndOrientation) {
  const Chain<double> chain(test::six_joint_arm());
  const auto path = arm_path();
  const ToolState<double> first = path.at(0.0);
  const auto start = PoseSearch<double>(chain, kAllRows, 1.0e-10)
                         .find({first.position_m, first.angles_rad}, {0.1, 0.2, 0.3, 0.2, 0.5, 0.1});
  ASSERT_TRUE(start.is_reached);
  Clik<double> clik(chain, {.gain_per_s = 50.0, .period_s = kPeriodS, .rows = kAllRows}, start.joints);
  double worst = 0.0;
  for (int k = 0; k <= 4000; ++k) worst = std::max(worst, clik.step(path.at(k * kPeriodS)).error.norm());
  // h a/(2 K) with joint accelerations of up to 10 rad/s2 on arms of 1 m.
  EXPECT_LE(worst, 1.0e-4);
}

TEST(KinematicsClik, JointAccelerationsAreTheDerivativesOfTheRates) {
  const Chain<double> chain(test::six_joint_arm());
  const auto path = arm_path();
  const ToolState<double> first = path.at(0.0);
  const auto start = PoseSearch<double>(chain, kAllRows, 1.0e-10)
                         .find({first.position_m, first.angles_rad}, {0.1, 0.2, 0.3, 0.2, 0.5, 0.1});
  constexpr double kShortS = 1.0e-5;
  Clik<double> clik(chain, {.gain_per_s = 50.0, .period_s = kShortS, .rows = kAllRows}, start.joints);
  ClikStep<double> before;
  for (int k = 0; k <= 60000; ++k) {
    const auto acceleration = clik.acceleration(path.at(k * kShortS));
    const ClikStep<double> now = clik.step(path.at(k * kShortS));
    if (k % 5000 == 4999) {
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR((now.rate[i] - before.rate[i]) / kShortS, acceleration[i], 1.0e-2) << k;
    }
    before = now;
  }
}

/// Largest joint rate while the two-link arm is led through its stretched position and back.
TEST(KinematicsClik, BesideASingularityTheJointsStayBoundedAndComeBack) {
  const Chain<double> chain(test::two_link_arm());
  const TaskRows rows = 0b000011;
  Clik<double> clik(chain, {.gain_per_s = 50.0, .period_s = kPeriodS, .rows = rows}, {0.0, 1.0});
  double fastest = 0.0;
  bool was_damped = false;
  ToolState<double> wanted;
  for (int k = 0; k <= 6000; ++k) {
    // Out of reach between 1.5 s and 3.9 s: 2.2 m.
    const double reach_m = 1.7 + 0.5 * std::sin(k * kPeriodS);
    wanted.position_m = {reach_m, 0.2, 0.0};
    wanted.speed(0) = 0.5 * std::cos(k * kPeriodS);
    const ClikStep<double> step = clik.step(wanted);
    if (k > 200) fastest = std::max({fastest, std::abs(step.rate[0]), std::abs(step.rate[1])});
    was_damped |= step.damping > 0.0;
  }
  EXPECT_TRUE(was_damped);
  // The gain asks for 50/s * 0.2 m; a singular value of 3 % of the largest makes 33 times that at most.
  EXPECT_LT(fastest, 330.0);
  EXPECT_LE(clik.step(wanted).error.norm(), 1.0e-3);
}

TEST(KinematicsClik, AwayFromSingularitiesNothingIsDamped) {
  const auto path = straight_path();
  Clik<double> clik(Chain<double>(morepro_table()), {50.0, kPeriodS}, start_of(path));
  for (int k = 0; k <= 2000; ++k) EXPECT_EQ(clik.step(path.at(k * kPeriodS)).damping, 0.0);
}

TEST(KinematicsPoseSearch, APoseOutOfReachIsSaidWithWhatIsLeft) {
  const PoseSearch<double> search(Chain<double>(test::two_link_arm()), 0b000011, 1.0e-9);
  const auto result = search.find({.position_m = {2.5, 0.0, 0.0}}, {0.3, 0.3});
  EXPECT_FALSE(result.is_reached);
  // The last steps across the singular direction are damped ones.
  EXPECT_NEAR(result.error.norm(), 0.5, 0.02);
}

TEST(KinematicsPoseSearch, LimitsHold) {
  DhTable table = test::two_link_arm();
  table.joints[1].lowest = 0.0;
  table.joints[1].highest = 1.0;
  const PoseSearch<double> search(Chain<double>(table), 0b000011, 1.0e-9);
  const auto result = search.find({.position_m = {0.5, 0.5, 0.0}}, {0.3, 0.3});
  EXPECT_FALSE(result.is_reached);
  EXPECT_LE(result.joints[1], 1.0);
}

}  // namespace
}  // namespace morepro::kinematics
