#pragma once
#include "lib/kinematics/task.hpp"

namespace morepro::kinematics {

/// Below this share of the largest mean square of three rows a direction counts as still: 0.3 % of the
/// largest lever, ten times what a float rounds.
inline constexpr double kStillShare = 1.0e-5;

namespace detail {

template <class Real>
int largest_of_diagonal(const Matrix3<Real>& m) {
  const int first = m(1, 1) > m(0, 0) ? 1 : 0;
  return m(2, 2) > m(first, first) ? 2 : first;
}

template <class Real>
Vector3<Real> unit(const Vector3<Real>& v) {
  return v * (Real(1) / math::sqrt(dot(v, v)));
}

/// (I - u u^T) m (I - u u^T) of a symmetric matrix.
template <class Real>
Matrix3<Real> without(const Matrix3<Real>& m, const Vector3<Real>& u) {
  const Vector3<Real> along = product(m, u);
  const Real both = dot(u, along);
  Matrix3<Real> rest;
  for (int r = 0; r < 3; ++r) {
    for (int s = 0; s < 3; ++s) rest(r, s) = m(r, s) - u(r) * along(s) - along(r) * u(s) + u(r) * u(s) * both;
  }
  return rest;
}

/// u u^T.
template <class Real>
Matrix3<Real> onto(const Vector3<Real>& u) {
  Matrix3<Real> m;
  for (int i = 0; i < 3; ++i) m.col(i) = u * u(i);
  return m;
}

/// Onto the directions n with n^T m n <= negligible, for a positive semidefinite m.
template <class Real>
Matrix3<Real> onto_null_space(const Matrix3<Real>& m, Real negligible) {
  const int first = largest_of_diagonal(m);
  if (!(m(first, first) > negligible)) return Matrix3<Real>::Identity();
  const Vector3<Real> a = unit<Real>(m.col(first));
  const Matrix3<Real> rest = without(m, a);
  const int second = largest_of_diagonal(rest);
  if (!(rest(second, second) > negligible)) return Matrix3<Real>::Identity() - onto(a);
  const Vector3<Real> normal = unit(cross(a, unit<Real>(rest.col(second))));
  return dot(normal, product(m, normal)) > negligible ? Matrix3<Real>(Matrix3<Real>::Zero()) : onto(normal);
}

/// Numbers in 0 .. 1, the same on every machine.
class PlainNumbers {
 public:
  template <class Real>
  Real between(Real low, Real high) {
    state_ = state_ * 1664525U + 1013904223U;
    return low + (high - low) * (static_cast<Real>(state_ >> 8U) * Real(1.0 / 16777216.0));
  }

 private:
  std::uint32_t state_ = 1;
};

}  // namespace detail

/// What a chain can do at all for a task, whatever its pose. Still directions: along or about them no joint
/// ever moves the tool, such as x for a gantry of y and z, or the normal of a planar arm, tilted or not. What
/// only some poses lack, such as the direction of a stretched arm, is none. And how far one m or rad of the
/// joints typically moves the tool in each row, so that m and rad, long and short levers compare. Both from
/// Jacobians at poses in general position. Made once for a chain, not for a pose.
template <class Real>
class Mobility {
 public:
  /// The chain's table must have been validated.
  Mobility(const Chain<Real>& chain, TaskRows rows) : rows_(rows) {
    Matrix3<Real> position = Matrix3<Real>::Zero();
    Matrix3<Real> angle = Matrix3<Real>::Zero();
    detail::PlainNumbers numbers;
    for (int k = 0; k < kPoses; ++k) {
      const Jacobian<Real> j = chain.jacobian(chain.frames(general_pose(chain, numbers)));
      add_square(j, 0, position);
      add_square(j, 3, angle);
    }
    take(position, position_, 0);
    take(angle, angle_, 3);
  }

  [[nodiscard]] TaskRows rows() const { return rows_; }

  /// Mean square of a row of the Jacobian; of a still row that of the largest one beside it. Above 0.
  [[nodiscard]] const Twist<Real>& typical_square() const { return typical_square_; }
  [[nodiscard]] const Twist<Real>& per_typical_square() const { return per_typical_square_; }

  /// Adds `scale` times the projector onto the still directions, rows outside the task among them, to the
  /// lower triangle of a matrix, as large as the rows beside them.
  void add_still(Real scale, Eigen::Matrix<Real, 6, 6>& m) const {
    for (int r = 0; r < 3; ++r) {
      for (int s = 0; s <= r; ++s) {
        m(r, s) += scale * position_.largest_square * position_.still(r, s);
        m(r + 3, s + 3) += scale * angle_.largest_square * angle_.still(r, s);
      }
    }
  }

  /// What of an error, 0 in rows outside the task, no joint can remove.
  [[nodiscard]] Twist<Real> still_part(const Twist<Real>& error) const {
    return twist_of(product(position_.still, Vector3<Real>(error.template head<3>())),
                    product(angle_.still, Vector3<Real>(error.template tail<3>())));
  }

 private:
  static constexpr int kPoses = 8;

  /// Of x, y, z or of wx, wy, wz.
  struct Block {
    Matrix3<Real> still;
    Real largest_square;
  };

  /// A slide without limits is taken within 1 m. A turn's limits do not matter to where axes can point.
  static JointVector<Real> general_pose(const Chain<Real>& chain, detail::PlainNumbers& numbers) {
    JointVector<Real> q{};
    for (std::size_t i = 0; i < chain.count(); ++i) {
      const bool turns = chain.is_revolute(i);
      const Real low = !turns && chain.lowest(i) > Real(-1) ? chain.lowest(i) : Real(-1);
      const Real high = !turns && chain.highest(i) < Real(1) ? chain.highest(i) : Real(1);
      q[i] = numbers.between(low, high) * (turns ? Real(3.14) : Real(1));
    }
    return q;
  }

  void add_square(const Jacobian<Real>& j, int first, Matrix3<Real>& square) const {
    for (int r = 0; r < 3; ++r) {
      for (int s = 0; s < 3; ++s) {
        if (!has_row(rows_, first + r) || !has_row(rows_, first + s)) continue;
        for (int i = 0; i < static_cast<int>(kMaxJoints); ++i)
          square(r, s) += j(first + r, i) * j(first + s, i) * Real(1.0 / kPoses);
      }
    }
  }

  void take(const Matrix3<Real>& square, Block& block, int first) {
    const int strongest = detail::largest_of_diagonal(square);
    const Real largest = square(strongest, strongest) > Real(0) ? square(strongest, strongest) : Real(1);
    const Real negligible = Real(kStillShare) * largest;
    block = {detail::onto_null_space(square, negligible), largest};
    for (int r = 0; r < 3; ++r) {
      typical_square_(first + r) = square(r, r) > negligible ? square(r, r) : largest;
      per_typical_square_(first + r) = Real(1) / typical_square_(first + r);
    }
  }

  TaskRows rows_;
  Block position_;
  Block angle_;
  Twist<Real> typical_square_;
  Twist<Real> per_typical_square_;
};

}  // namespace morepro::kinematics
