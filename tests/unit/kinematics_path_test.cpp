#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lib/kinematics/path.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro::kinematics {
namespace {

using SmallPath = Path<double, 3>;

Waypoint<double> at(double x, double y, double z, double roll = 0.0) { return {{x, y, z}, {roll, 0.0, 0.0}}; }

TEST(KinematicsPath, ASpeedProfileCoversExactlyItsWayAndRestsAtBothEnds) {
  for (const double ramp_share : {0.05, 1.0 / 3.0, 0.5}) {
    const SpeedProfile<double> profile(2.0, ramp_share);
    EXPECT_EQ(profile.at(0.0).share, 0.0);
    EXPECT_EQ(profile.at(0.0).rate, 0.0);
    EXPECT_EQ(profile.at(2.0).share, 1.0);
    EXPECT_EQ(profile.at(2.0).rate, 0.0);
    EXPECT_DOUBLE_EQ(profile.at(1.0).share, 0.5);
    EXPECT_DOUBLE_EQ(profile.at(1.0).rate, 1.0 / (2.0 - 2.0 * ramp_share));
  }
}

// Central differences over 2e-6 s: the second derivative jumps by less than 30 /s2, times half the step.
TEST(KinematicsPath, RateAndAccelerationAreTheDerivativesOfTheWay) {
  const SpeedProfile<double> profile(1.5, 0.2);
  constexpr double kStep = 1.0e-6;
  for (double t = 0.01; t < 1.49; t += 0.0173) {
    const double rate = (profile.at(t + kStep).share - profile.at(t - kStep).share) / (2.0 * kStep);
    const double acceleration = (profile.at(t + kStep).rate - profile.at(t - kStep).rate) / (2.0 * kStep);
    EXPECT_NEAR(profile.at(t).rate, rate, 1.0e-8) << t;
    EXPECT_NEAR(profile.at(t).acceleration, acceleration, 1.0e-8) << t;
  }
}

TEST(KinematicsPath, OutsideItsTimeAProfileRests) {
  const SpeedProfile<double> profile(1.0, 0.3);
  EXPECT_EQ(profile.at(-0.1).share, 0.0);
  EXPECT_EQ(profile.at(1.1).share, 1.0);
  for (const double t : {-0.1, 1.1}) {
    EXPECT_EQ(profile.at(t).rate, 0.0);
    EXPECT_EQ(profile.at(t).acceleration, 0.0);
  }
}

TEST(KinematicsPath, CoincidentPointsAreRefused) {
  SmallPath path;
  EXPECT_EQ(path.add(at(0.1, 0.2, 0.3, 0.4), 0.0), PathError::kNone);
  EXPECT_EQ(path.add(at(0.1, 0.2, 0.3, 0.4), 1.0), PathError::kCoincident);
  EXPECT_EQ(path.add(at(0.1, 0.2, 0.3 + 1.0e-10, 0.4), 1.0), PathError::kCoincident);
  EXPECT_EQ(path.points(), 1U);
  EXPECT_EQ(path.add(at(0.1, 0.2, 0.3, 0.5), 1.0), PathError::kNone) << "the tool may turn where it stands";
}

TEST(KinematicsPath, ImpossibleTimesAreRefused) {
  for (const double duration : {0.0, -1.0, 1.0e-300, test::kNan<double>, test::kInfinity<double>}) {
    SmallPath path;
    EXPECT_EQ(path.add(at(0, 0, 0), 0.0), PathError::kNone);
    EXPECT_EQ(path.add(at(1, 0, 0), duration), PathError::kTime) << duration;
  }
  for (const double ramp_share : {0.0, -0.1, 0.51, test::kNan<double>}) {
    SmallPath path({}, ramp_share);
    EXPECT_EQ(path.add(at(0, 0, 0), 0.0), PathError::kNone);
    EXPECT_EQ(path.add(at(1, 0, 0), 1.0), PathError::kTime) << ramp_share;
  }
}

TEST(KinematicsPath, PointsThatAreNoNumbersOrTooManyAreRefused) {
  SmallPath path;
  EXPECT_EQ(path.add(at(test::kNan<double>, 0, 0), 0.0), PathError::kNotFinite);
  EXPECT_EQ(path.add(at(0, 0, 0, test::kInfinity<double>), 0.0), PathError::kNotFinite);
  for (const double x : {0.0, 1.0, 2.0}) EXPECT_EQ(path.add(at(x, 0, 0), 1.0), PathError::kNone);
  EXPECT_EQ(path.add(at(3.0, 0, 0), 1.0), PathError::kFull);
  EXPECT_EQ(path.duration_s(), 2.0);
}

TEST(KinematicsPath, TheToolRestsInEveryPointAndTheNextSegmentBeginsThere) {
  SmallPath path;
  ASSERT_EQ(path.add(at(0, 0, 0), 0.0), PathError::kNone);
  ASSERT_EQ(path.add(at(1, 0, 0), 2.0), PathError::kNone);
  ASSERT_EQ(path.add(at(1, 1, 0), 1.0), PathError::kNone);
  EXPECT_EQ(path.segment_at(1.999), 0U);
  EXPECT_EQ(path.segment_at(2.0), 1U);
  EXPECT_EQ(path.segment_at(3.0), 1U);
  EXPECT_EQ(path.at(2.0).speed.norm(), 0.0);
  EXPECT_GT(path.at(2.0).acceleration(1), 0.0);
  EXPECT_LT(path.at(3.0).acceleration(1), 0.0);
  EXPECT_EQ(path.at(2.5).position_m, Vector3<double>(1.0, 0.5, 0.0));
  EXPECT_EQ(path.at(9.0).position_m, Vector3<double>(1.0, 1.0, 0.0));
}

TEST(KinematicsPath, ThePlacementMovesThePointsAndNotTheAngles) {
  SmallPath path({rotation_z(std::acos(0.0)), {1.0, 2.0, 3.0}});
  ASSERT_EQ(path.add(at(0, 0, 0, 0.3), 0.0), PathError::kNone);
  ASSERT_EQ(path.add(at(1, 0, 0, 0.4), 1.0), PathError::kNone);
  EXPECT_LE((path.at(1.0).position_m - Vector3<double>(1.0, 3.0, 3.0)).norm(), 1.0e-15);
  EXPECT_DOUBLE_EQ(path.at(1.0).angles_rad(0), 0.4);
}

TEST(KinematicsPath, ARollMayBeMoreThanATurn) {
  SmallPath path;
  ASSERT_EQ(path.add(at(0, 0, 0, 1.0), 0.0), PathError::kNone);
  ASSERT_EQ(path.add(at(0, 0, 0, 21.0), 2.0), PathError::kNone);
  EXPECT_DOUBLE_EQ(path.at(1.0).angles_rad(0), 11.0);
  EXPECT_DOUBLE_EQ(path.at(1.0).speed(3), 20.0 / (2.0 - 2.0 / 3.0));
  EXPECT_LE((path.at(1.0).turn - rotation_x(11.0)).cwiseAbs().maxCoeff(), 1.0e-14);
}

/// The turn of the tool at t + dt, taken as a rotation from that at t, gives the angular speed.
TEST(KinematicsPath, ATurnAboutAnyAxisIsEvenAndEndsWhereItShall) {
  SmallPath path;
  const Waypoint<double> from{{0, 0, 0}, {0.3, -0.4, 0.5}};
  const Waypoint<double> to{{0, 0, 1}, {-1.0, 0.6, 1.9}};
  ASSERT_EQ(path.add(from, 0.0), PathError::kNone);
  ASSERT_EQ(path.add(to, 1.0), PathError::kNone);
  EXPECT_LE((path.at(1.0).angles_rad - to.angles_rad).norm(), 1.0e-14);
  for (const double t : {0.2, 0.5, 0.77}) {
    const Matrix3<double> turned = path.at(t + 1.0e-5).turn * path.at(t - 1.0e-5).turn.transpose();
    EXPECT_LE((rotation_vector(turned) / 2.0e-5 - path.at(t).speed.tail<3>()).norm(), 1.0e-9);
  }
}

TEST(KinematicsPath, ATurnAboutOneTiltedAxisIsNotTakenForASumOfAngles) {
  for (const auto& [from, to] : {std::pair{Vector3<double>(0.0, 0.9, 0.0), Vector3<double>(1.2, 0.9, 0.0)},
                                 std::pair{Vector3<double>(0.0, 0.0, 0.8), Vector3<double>(0.0, 1.2, 0.8)}}) {
    const Segment<double> segment({.angles_rad = from}, {.angles_rad = to}, 1.0, 0.3);
    EXPECT_LE((segment.at(1.0).turn - rotation_of(to)).cwiseAbs().maxCoeff(), 1.0e-14);
  }
}

}  // namespace
}  // namespace morepro::kinematics
