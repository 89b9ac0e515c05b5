#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>

#include "lib/kinematics/dh_table.hpp"
#include "lib/kinematics/joint_vector.hpp"
#include "lib/kinematics/transform.hpp"

namespace morepro::kinematics {

/// Geometric Jacobian: rows x, y, z, wx, wy, wz of the tool in the base's axes, a column per joint; columns
/// beyond the chain's count are 0.
template <class Real>
using Jacobian = Eigen::Matrix<Real, 6, static_cast<int>(kMaxJoints)>;

/// {x, y, z, wx, wy, wz}: a speed, an acceleration or an error of the tool in the base's axes; m and rad.
template <class Real>
using Twist = Eigen::Matrix<Real, 6, 1>;

template <class Real>
Twist<Real> twist_of(const Vector3<Real>& linear, const Vector3<Real>& angular) {
  Twist<Real> twist;
  twist.template head<3>() = linear;
  twist.template tail<3>() = angular;
  return twist;
}

/// Frames of a chain in the base: frame[0] is the base, frame[i] is behind joint i, frame[count] is the tool.
template <class Real>
struct ChainFrames {
  std::array<Transform<Real>, kMaxJoints + 1> frame{};
  std::size_t count = 0;

  [[nodiscard]] const Transform<Real>& tool() const { return frame[count]; }
  /// Axis of joint i, from 0: z of the frame before it (equation 4).
  [[nodiscard]] Vector3<Real> axis(std::size_t i) const { return frame[i].rotation.col(2); }
};

/// Direct kinematics of a chain of up to kMaxJoints prismatic and revolute joints. Fixed memory; every
/// function may run in an interrupt.
template <class Real>
class Chain {
 public:
  /// The table must have been validated.
  explicit Chain(const DhTable& table) : count_(table.count) {
    for (std::size_t i = 0; i < count_; ++i) joints_[i] = Joint(table.joints[i]);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool is_revolute(std::size_t i) const { return joints_[i].is_revolute; }
  [[nodiscard]] bool is_within_limits(const JointVector<Real>& q) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (!(q[i] >= joints_[i].lowest && q[i] <= joints_[i].highest)) return false;
    }
    return true;
  }

  /// A_n^0 = A_1^0 A_2^1 .. A_n^(n-1), every product on the way kept.
  [[nodiscard]] ChainFrames<Real> frames(const JointVector<Real>& q) const {
    ChainFrames<Real> result{.count = count_};
    for (std::size_t i = 0; i < count_; ++i) result.frame[i + 1] = joints_[i].behind(result.frame[i], q[i]);
    return result;
  }

  /// Equation 4: a prismatic joint moves the tool along its axis, a revolute one turns it about that axis.
  [[nodiscard]] Jacobian<Real> jacobian(const ChainFrames<Real>& frames) const {
    Jacobian<Real> j = Jacobian<Real>::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      const auto column = static_cast<int>(i);
      const Vector3<Real> axis = frames.axis(i);
      const Vector3<Real> arm_m = frames.tool().position_m - frames.frame[i].position_m;
      j.template block<3, 1>(0, column) = is_revolute(i) ? cross(axis, arm_m) : axis;
      if (is_revolute(i)) j.template block<3, 1>(3, column) = axis;
    }
    return j;
  }

  /// Of every joint's variable, m or rad; infinite where the joint has none.
  [[nodiscard]] Real lowest(std::size_t i) const { return joints_[i].lowest; }
  [[nodiscard]] Real highest(std::size_t i) const { return joints_[i].highest; }

 private:
  struct Joint {
    Joint() = default;
    explicit Joint(const DhJoint& row)
        : is_revolute(row.kind == JointKind::kRevolute),
          a(Real(row.a_m)),
          d(Real(row.d_m)),
          theta(Real(row.theta_rad)),
          fixed_turn(exact(math::sin_cos(Real(row.theta_rad)))),
          twist(exact(math::sin_cos(Real(row.alpha_rad)))),
          lowest(Real(row.lowest)),
          highest(Real(row.highest)) {}

    /// A quarter turn has no exact value in rad: below one rounding of 1 its zero is a zero.
    static math::SinCos<Real> exact(math::SinCos<Real> x) {
      constexpr Real kRounding = std::numeric_limits<Real>::epsilon();
      if (math::abs(x.sin) < kRounding) return {0, x.cos > 0 ? Real(1) : Real(-1)};
      if (math::abs(x.cos) < kRounding) return {x.sin > 0 ? Real(1) : Real(-1), 0};
      return x;
    }

    /// The frame before, times A_i^(i-1) of equation 3: a turn about z, then one about the new x, of which a
    /// product of two full matrices would be twice the work.
    [[nodiscard]] Transform<Real> behind(const Transform<Real>& before, Real variable) const {
      const auto [s, c] = is_revolute ? math::sin_cos(theta + variable) : fixed_turn;
      const Vector3<Real> x = before.rotation.col(0) * c + before.rotation.col(1) * s;
      const Vector3<Real> y = before.rotation.col(1) * c - before.rotation.col(0) * s;
      const Vector3<Real> z = before.rotation.col(2);
      Transform<Real> after;
      after.rotation.col(0) = x;
      after.rotation.col(1) = y * twist.cos + z * twist.sin;
      after.rotation.col(2) = z * twist.cos - y * twist.sin;
      after.position_m = before.position_m + z * (is_revolute ? d : d + variable) + x * a;
      return after;
    }

    bool is_revolute = false;
    Real a = 0;
    Real d = 0;
    Real theta = 0;
    math::SinCos<Real> fixed_turn{0, 1};
    math::SinCos<Real> twist{0, 1};
    Real lowest = 0;
    Real highest = 0;
  };

  std::array<Joint, kMaxJoints> joints_{};
  std::size_t count_;
};

/// Equation 6: the rows x, y, z, wx of a chain of four joints.
template <class Real>
Matrix4<Real> reduced(const Jacobian<Real>& j) {
  return j.template topLeftCorner<4, 4>();
}

}  // namespace morepro::kinematics
