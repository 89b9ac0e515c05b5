#include <gtest/gtest.h>

#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/path.hpp"
#include "lib/kinematics/pose_search.hpp"
#include "tests/support/chains.hpp"

namespace morepro::kinematics {
namespace {

constexpr double kStepS = 1.0e-3;
constexpr double kQuarterTurn = 1.57079632679489661923;

/// Two slides, the second one turned away from the first by `skew_rad`, both turned about z by `yaw_rad`.
DhTable gantry(double yaw_rad, double skew_rad) {
  DhTable table{.count = 2};
  table.joints[0] = {JointKind::kPrismatic, 0.2, 0.0, skew_rad, yaw_rad};
  table.joints[1] = {JointKind::kPrismatic, 0.1};
  return table;
}

/// A two-link arm with links of some length and a wrist about the same axis.
DhTable arm_with_wrist(double link_m) {
  DhTable table{.count = 3};
  for (std::size_t i = 0; i < 2; ++i) table.joints[i] = {JointKind::kRevolute, link_m};
  table.joints[2] = {JointKind::kRevolute};
  return table;
}

/// Both ends of a path where the joints put the tool, 2 s.
Path<double, 2> path_between(const Chain<double>& chain, const JointVector<double>& from,
                             const JointVector<double>& to) {
  Path<double, 2> path;
  EXPECT_EQ(path.add({.position_m = chain.frames(from).tool().position_m}, 0.0), PathError::kNone);
  EXPECT_EQ(path.add({.position_m = chain.frames(to).tool().position_m}, 2.0), PathError::kNone);
  return path;
}

/// h a/(2 K) with the acceleration that the joints' accelerations have to make, x'' - J' q', against the
/// error after `time_s` on the way from one pose to another. Relative.
double residual_off_prediction(const DhTable& table, const JointVector<double>& from,
                               const JointVector<double>& to, double gain_per_s, double time_s) {
  const Chain<double> chain(table);
  const auto path = path_between(chain, from, to);
  Clik<double> clik(chain, {gain_per_s, kStepS, kPositionRows}, from);
  const int steps = static_cast<int>(time_s / kStepS + 0.5);
  for (int k = 0; k < steps; ++k) clik.step(path.at(k * kStepS));
  const auto wanted = path.at(steps * kStepS);
  const ClikStep<double> step = clik.solve(wanted);
  EXPECT_EQ(step.damping, 0.0);
  const auto bias = rate_of_jacobian_times_rate(chain, chain.frames(clik.joints()), step.rate);
  Twist<double> predicted = (wanted.acceleration - bias) * (kStepS / (2.0 * gain_per_s));
  predicted.tail<3>().setZero();
  return (step.error - predicted).norm() / predicted.norm();
}

TEST(KinematicsMobility, TheResidualOfAGantryOfTwoAxesIsAsPredicted) {
  for (const double gain : {30.0, 50.0, 400.0})
    EXPECT_LE(residual_off_prediction(gantry(0.0, -kQuarterTurn), {0.1, 0.2}, {0.4, -0.3}, gain, 0.6), 0.01);
}

TEST(KinematicsMobility, TheResidualOfATurnedAndSkewedGantryIsAsPredicted) {
  for (const double skew : {-kQuarterTurn, 0.9})
    EXPECT_LE(residual_off_prediction(gantry(0.5, skew), {0.1, 0.2}, {0.4, -0.3}, 50.0, 0.6), 0.01) << skew;
}

TEST(KinematicsMobility, TheResidualOfAPlanarArmIsAsPredicted) {
  const JointVector<double> from{0.2, 1.2};
  const JointVector<double> to{0.5, 0.9};
  for (const double time_s : {0.1, 0.6})
    EXPECT_LE(residual_off_prediction(test::two_link_arm(), from, to, 400.0, time_s), 0.01) << time_s;
}

TEST(KinematicsMobility, MetresAndRadiansLongAndShortLeversCompare) {
  for (const double link_m : {0.005, 0.5, 100.0}) {
    const Chain<double> chain(arm_with_wrist(link_m));
    const Mobility<double> mobility(chain, 0b100111);
    const auto jacobian = chain.jacobian(chain.frames({0.3, 1.0, 0.2}));
    EXPECT_EQ(DampedInverse<double>(mobility, 3, jacobian).damping(), 0.0) << link_m;
  }
}

template <class Real>
void expect_stretched_is_damped() {
  const Chain<Real> chain(test::two_link_arm());
  const Mobility<Real> mobility(chain, kPositionRows);
  const auto damping_at = [&](Real elbow_rad) {
    return DampedInverse<Real>(mobility, 2, chain.jacobian(chain.frames({Real(0.0), elbow_rad}))).damping();
  };
  EXPECT_GT(damping_at(Real(0.0)), Real(0.0));
  EXPECT_GT(damping_at(Real(0.01)), Real(0.0));
  EXPECT_EQ(damping_at(Real(0.5)), Real(0.0));
}

// Along x no joint moves the stretched arm, but at other poses they do.
TEST(KinematicsMobility, AStretchedArmIsDampedStill) {
  expect_stretched_is_damped<double>();
  expect_stretched_is_damped<float>();
}

TEST(KinematicsMobility, WhatNoJointMovesIsTheStillPartOfAnError) {
  const Twist<double> error = (Twist<double>() << 0.1, 0.2, 0.3, 0.0, 0.0, 0.0).finished();
  const Mobility<double> arm(Chain<double>(test::two_link_arm()), kPositionRows);
  EXPECT_LE((arm.still_part(error) - Twist<double>::Unit(2) * 0.3).norm(), 1.0e-15);
  const Mobility<double> slides(Chain<double>(gantry(0.5, 0.9)), kPositionRows);
  const Vector3<double> normal(std::cos(0.5), std::sin(0.5), 0.0);
  EXPECT_LE((slides.still_part(error).head<3>() - normal * normal.dot(error.head<3>())).norm(), 1.0e-15);
}

TEST(KinematicsMobility, NoJointMovesAStillDirectionOfARandomChain) {
  test::RandomChains random(7);
  for (int k = 0; k < 300; ++k) {
    const DhTable table = random.table();
    const Chain<double> chain(table);
    const Mobility<double> mobility(chain, kAllRows);
    const auto jacobian = chain.jacobian(chain.frames(random.joints(table, 3.0)));
    for (std::size_t i = 0; i < table.count; ++i) {
      const Twist<double> column = jacobian.col(static_cast<int>(i));
      EXPECT_LE(mobility.still_part(column).norm(), 1.0e-2 * column.norm()) << k;
    }
  }
}

TEST(KinematicsMobility, AChainThatMovesEverywhereHasNoStillDirection) {
  const Mobility<float> mobility(Chain<float>(test::six_joint_arm()), kAllRows);
  EXPECT_EQ(mobility.still_part(Twist<float>::Ones()).norm(), 0.0F);
}

}  // namespace
}  // namespace morepro::kinematics
