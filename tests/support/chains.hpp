#pragma once
#include <random>

#include "lib/kinematics/chain.hpp"

namespace morepro::test {

/// Chains of every length with joints of both kinds, links of up to 1 m, any twist.
class RandomChains {
 public:
  explicit RandomChains(unsigned seed) : random_(seed) {}

  kinematics::DhTable table() {
    kinematics::DhTable table{.count = 1 + random_() % kinematics::kMaxJoints};
    for (std::size_t i = 0; i < table.count; ++i) {
      const auto kind =
          random_() % 3 == 0 ? kinematics::JointKind::kPrismatic : kinematics::JointKind::kRevolute;
      table.joints[i] = {kind, between(-1.0, 1.0), between(-1.0, 1.0), between(-3.0, 3.0),
                         between(-3.0, 3.0)};
    }
    return table;
  }

  /// One number per joint of the table, the others 0.
  kinematics::JointVector<double> joints(const kinematics::DhTable& table, double size) {
    kinematics::JointVector<double> q{};
    for (std::size_t i = 0; i < table.count; ++i) q[i] = between(-size, size);
    return q;
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  std::mt19937 random_;
};

/// Two links of 1 m in a plane: positions in x and y, singular where it is stretched or folded.
inline kinematics::DhTable two_link_arm() {
  kinematics::DhTable table{.count = 2};
  table.joints[0] = {kinematics::JointKind::kRevolute, 1.0};
  table.joints[1] = {kinematics::JointKind::kRevolute, 1.0};
  return table;
}

/// Six revolute joints, a shoulder, an elbow and a wrist whose axes meet: the common industrial arm.
inline kinematics::DhTable six_joint_arm() {
  constexpr double kQuarterTurn = 1.57079632679489661923;
  constexpr auto kTurn = kinematics::JointKind::kRevolute;
  kinematics::DhTable table{.count = 6};
  table.joints[0] = {kTurn, 0.05, 0.40, -kQuarterTurn, 0.0};
  table.joints[1] = {kTurn, 0.45, 0.0, 0.0, -kQuarterTurn};
  table.joints[2] = {kTurn, 0.04, 0.0, -kQuarterTurn, 0.0};
  table.joints[3] = {kTurn, 0.0, 0.42, kQuarterTurn, 0.0};
  table.joints[4] = {kTurn, 0.0, 0.0, -kQuarterTurn, 0.0};
  table.joints[5] = {kTurn, 0.0, 0.08, 0.0, 0.0};
  return table;
}

}  // namespace morepro::test
