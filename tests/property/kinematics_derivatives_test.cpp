#include <gtest/gtest.h>

#include <algorithm>

#include "lib/kinematics/differential.hpp"
#include "lib/kinematics/pose_search.hpp"
#include "tests/support/chains.hpp"

namespace morepro::kinematics {
namespace {

constexpr int kChains = 300;
constexpr double kDifferenceS = 1.0e-6;

JointVector<double> moved(JointVector<double> q, const JointVector<double>& rate, double time_s) {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += rate[i] * time_s;
  return q;
}

/// The tool's speed by central differences of its pose.
Twist<double> measured_speed(const Chain<double>& chain, const JointVector<double>& q,
                             const JointVector<double>& rate) {
  const auto after = chain.frames(moved(q, rate, kDifferenceS)).tool();
  const auto before = chain.frames(moved(q, rate, -kDifferenceS)).tool();
  const Matrix3<double> turned = after.rotation * before.rotation.transpose();
  const Vector3<double> way_m = after.position_m - before.position_m;
  return twist_of(way_m, rotation_vector(turned)) / (2.0 * kDifferenceS);
}

// Rounding of positions up to 10 m, 2e-15, over the step of 2e-6 makes 1e-9; the third derivative leaves
// 1e-11.
TEST(KinematicsDerivatives, JacobianEqualsCentralDifferencesOnRandomChains) {
  test::RandomChains random(11);
  double worst = 0.0;
  Jacobian<double> largest = Jacobian<double>::Zero();
  for (int k = 0; k < kChains; ++k) {
    const DhTable table = random.table();
    const Chain<double> chain(table);
    const auto q = random.joints(table, 3.0);
    const Jacobian<double> j = chain.jacobian(chain.frames(q));
    for (std::size_t i = 0; i < kMaxJoints; ++i) {
      JointVector<double> rate{};
      if (i < table.count) rate[i] = 1.0;
      const Twist<double> difference = j.col(static_cast<int>(i)) - measured_speed(chain, q, rate);
      worst = std::max(worst, difference.cwiseAbs().maxCoeff());
    }
    largest = largest.cwiseMax(j.cwiseAbs());
  }
  EXPECT_LE(worst, 1.0e-7);
  // Of no entry could the sign be flipped unseen; the first joint moves along or turns about the axis of the
  // base: two of its entries are zero in every pose.
  EXPECT_GE(largest.rightCols<kMaxJoints - 1>().minCoeff(), 0.1);
  EXPECT_EQ((largest.col(0).array() > 0.1).count(), 4);
}

TEST(KinematicsDerivatives, RateOfTheJacobianEqualsCentralDifferencesOnRandomChains) {
  test::RandomChains random(12);
  double worst = 0.0;
  for (int k = 0; k < kChains; ++k) {
    const DhTable table = random.table();
    const Chain<double> chain(table);
    const auto q = random.joints(table, 3.0);
    const auto rate = random.joints(table, 1.0);
    const auto speed_at = [&](double time_s) {
      return tool_speed(chain, chain.jacobian(chain.frames(moved(q, rate, time_s))), rate);
    };
    const Twist<double> measured = (speed_at(kDifferenceS) - speed_at(-kDifferenceS)) / (2.0 * kDifferenceS);
    const Twist<double> ours = rate_of_jacobian_times_rate(chain, chain.frames(q), rate);
    worst = std::max(worst, (ours - measured).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst, 1.0e-7);
}

template <class Real>
Chain<Real> chain_of(const DhTable& table) {
  return Chain<Real>(table);
}

// Up to eight products, each adding a rounding of 6e-8 of positions up to 12 m and of angles up to 6 rad
// (2.4e-7) on arms of that length: 1e-5; the largest of these runs is 4e-6.
TEST(KinematicsDerivatives, FloatStaysBesideDoubleOnRandomChains) {
  test::RandomChains random(13);
  double worst = 0.0;
  for (int k = 0; k < kChains; ++k) {
    const DhTable table = random.table();
    const auto q = random.joints(table, 3.0);
    JointVector<float> q_float{};
    for (std::size_t i = 0; i < q.size(); ++i) q_float[i] = static_cast<float>(q[i]);
    const auto wide = chain_of<double>(table).frames(q);
    const auto narrow = chain_of<float>(table).frames(q_float);
    const Vector3<double> position = narrow.tool().position_m.cast<double>() - wide.tool().position_m;
    worst = std::max(worst, position.cwiseAbs().maxCoeff());
    const Jacobian<double> j = chain_of<float>(table).jacobian(narrow).cast<double>();
    worst = std::max(worst, (j - chain_of<double>(table).jacobian(wide)).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst, 1.0e-5);
  RecordProperty("worst_difference", std::to_string(worst));
}

TEST(KinematicsDerivatives, ThePoseSearchFindsPosesThatTheArmCanTake) {
  test::RandomChains random(14);
  const DhTable table = test::six_joint_arm();
  const Chain<double> chain(table);
  const Matrix3<double> home = chain.frames({}).tool().rotation;
  const PoseSearch<double> search(chain, kAllRows, 1.0e-9);
  int found = 0;
  for (int k = 0; k < 100; ++k) {
    const auto tool = chain.frames(random.joints(table, 1.5)).tool();
    const Waypoint<double> pose{tool.position_m,
                                angles_of(Matrix3<double>(tool.rotation * home.transpose()))};
    bool is_reached = false;
    for (int start = 0; start < 32 && !is_reached; ++start)
      is_reached = search.find(pose, random.joints(table, 1.5)).is_reached;
    found += is_reached ? 1 : 0;
  }
  EXPECT_EQ(found, 100);
}

}  // namespace
}  // namespace morepro::kinematics
