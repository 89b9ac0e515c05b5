#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lib/kinematics/differential.hpp"
#include "lib/kinematics/morepro_machine.hpp"
#include "tests/support/chains.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro::kinematics {
namespace {

template <class Change>
TableStatus status_after(Change change) {
  DhTable table = morepro_table();
  change(table);
  return table.validate();
}

TEST(KinematicsChain, TheBuiltInTableIsValid) { EXPECT_TRUE(morepro_table().validate().is_good()); }

TEST(KinematicsChain, ATableWithTheWrongNumberOfJointsIsRefused) {
  EXPECT_EQ(DhTable{}.validate().error, TableError::kNoJoints);
  EXPECT_EQ(status_after([](DhTable& t) { t.count = kMaxJoints + 1; }).error, TableError::kTooManyJoints);
}

TEST(KinematicsChain, AnImpossibleJointIsNamed) {
  const auto wrong = [](auto change) { return status_after([&](DhTable& t) { change(t.joints[2]); }); };
  const auto expect = [](TableStatus status, TableError error) {
    EXPECT_EQ(status.error, error);
    EXPECT_EQ(status.joint, 2U);
  };
  expect(wrong([](DhJoint& j) { j.kind = static_cast<JointKind>(7); }), TableError::kUnknownKind);
  for (const double bad : {test::kNan<double>, test::kInfinity<double>, -2.0e3}) {
    expect(wrong([bad](DhJoint& j) { j.a_m = bad; }), TableError::kLength);
    expect(wrong([bad](DhJoint& j) { j.d_m = bad; }), TableError::kLength);
    expect(wrong([bad](DhJoint& j) { j.alpha_rad = bad; }), TableError::kAngle);
    expect(wrong([bad](DhJoint& j) { j.theta_rad = bad; }), TableError::kAngle);
  }
  expect(wrong([](DhJoint& j) { j.lowest = j.highest = 0.1; }), TableError::kLimits);
  expect(wrong([](DhJoint& j) { j.highest = test::kNan<double>; }), TableError::kLimits);
}

/// A_i^(i-1), equation 3 of the thesis, letter by letter.
Matrix4<double> equation_three(const DhJoint& joint, double variable) {
  const bool is_revolute = joint.kind == JointKind::kRevolute;
  const double theta = joint.theta_rad + (is_revolute ? variable : 0.0);
  const double d = joint.d_m + (is_revolute ? 0.0 : variable);
  const double a = joint.a_m;
  const auto [s, c] = math::sin_cos(theta);
  const auto [sa, ca] = math::sin_cos(joint.alpha_rad);
  Matrix4<double> m;
  m << c, -s * ca, s * sa, a * c, s, c * ca, -c * sa, a * s, 0, sa, ca, d, 0, 0, 0, 1;
  return m;
}

// Eight products of numbers up to 10.
TEST(KinematicsChain, FramesAreTheProductsOfEquationThree) {
  test::RandomChains random(21);
  for (int k = 0; k < 100; ++k) {
    const DhTable table = random.table();
    const auto q = random.joints(table, 3.0);
    const auto frames = Chain<double>(table).frames(q);
    Matrix4<double> product = Matrix4<double>::Identity();
    for (std::size_t i = 0; i < table.count; ++i) {
      product = (product * equation_three(table.joints[i], q[i])).eval();
      EXPECT_LE((frames.frame[i + 1].matrix() - product).cwiseAbs().maxCoeff(), 2.0e-14) << k << " " << i;
    }
  }
}

// The thesis's equation 6: a permutation, its own inverse, without a singularity.
template <class Real>
void expect_equation_six(const JointVector<Real>& q) {
  const Chain<Real> chain(morepro_table());
  Matrix4<Real> expected;
  expected << 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1;
  const Jacobian<Real> j = chain.jacobian(chain.frames(q));
  EXPECT_EQ(reduced(j), expected);
  EXPECT_EQ(reduced(j).determinant(), Real(-1));
  EXPECT_EQ((j.template bottomRows<2>().cwiseAbs().maxCoeff()), Real(0));
}

TEST(KinematicsChain, TheReducedJacobianIsEquationSixEverywhere) {
  for (const double t4 : {0.0, 0.7, 1.5707963267948966, -3.0, 12.0}) {
    expect_equation_six<double>({0.1, -0.2, 0.3, t4});
    expect_equation_six<float>({0.1F, -0.2F, 0.3F, static_cast<float>(t4)});
  }
}

TEST(KinematicsChain, TheToolOfThisMachineNeverTilts) {
  const Chain<double> chain(morepro_table());
  for (const double t4 : {0.0, 1.0, 2.5, -0.4})
    EXPECT_EQ(chain.frames({0.1, 0.2, 0.3, t4}).tool().rotation.col(2), Vector3<double>(1.0, 0.0, 0.0));
}

TEST(KinematicsChain, ClosedFormInverseLeadsBackToThePose) {
  const MachineGeometry offsets{0.3, 0.2, 0.1, 0.05};
  const Chain<double> chain(morepro_table(offsets));
  const RollPose<double> pose{{0.51, -0.23, 0.77}, 2.2};
  const Transform<double> tool = chain.frames(inverse_of(offsets, pose)).tool();
  EXPECT_LE((tool.position_m - pose.position_m).cwiseAbs().maxCoeff(), 1.0e-15);
  const Matrix3<double> home = chain.frames({}).tool().rotation;
  EXPECT_LE((tool.rotation - rotation_x(2.2) * home).cwiseAbs().maxCoeff(), 1.0e-15);
}

TEST(KinematicsChain, ClosedFormRatesAreTheInverseOfTheJacobian) {
  const Chain<double> chain(morepro_table());
  const auto rate = inverse_rates_of<double>({0.1, -0.2, 0.3}, 0.4);
  Twist<double> expected;
  expected << 0.1, -0.2, 0.3, 0.4, 0.0, 0.0;
  EXPECT_EQ(tool_speed(chain, chain.jacobian(chain.frames({0.1, 0.1, 0.1, 0.1})), rate), expected);
}

TEST(KinematicsChain, LimitsAreInclusiveAndNanIsOutside) {
  DhTable table = morepro_table();
  table.joints[1].lowest = -0.5;
  table.joints[1].highest = 0.5;
  const Chain<double> chain(table);
  EXPECT_TRUE(chain.is_within_limits({0.9, 0.5, -0.9, 9.0}));
  EXPECT_TRUE(chain.is_within_limits({0.9, -0.5, -0.9, 9.0}));
  EXPECT_FALSE(chain.is_within_limits({0.0, 0.500001, 0.0, 0.0}));
  EXPECT_FALSE(chain.is_within_limits({0.0, -0.6, 0.0, 0.0}));
  EXPECT_FALSE(chain.is_within_limits({0.0, test::kNan<double>, 0.0, 0.0}));
}

}  // namespace
}  // namespace morepro::kinematics
