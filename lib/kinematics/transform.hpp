#pragma once
#include <Eigen/Core>

#include "lib/math/elementary.hpp"

namespace morepro::kinematics {

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
template <class Real>
using Matrix4 = Eigen::Matrix<Real, 4, 4>;

/// In one order on every machine: the order of Eigen's sums follows the vector width.
template <class Real, int kSize>
Real dot(const Eigen::Matrix<Real, kSize, 1>& a, const Eigen::Matrix<Real, kSize, 1>& b) {
  Real sum = 0;
  for (int i = 0; i < kSize; ++i) sum += a(i) * b(i);
  return sum;
}

template <class Real>
Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

/// Products in one order and with one rounding per operation: Eigen's own fuse or reorder them where the
/// machine has vectors for it.
template <class Real>
Vector3<Real> product(const Matrix3<Real>& m, const Vector3<Real>& v) {
  return (m.col(0) * v(0) + m.col(1) * v(1)) + m.col(2) * v(2);
}
template <class Real>
Matrix3<Real> product(const Matrix3<Real>& a, const Matrix3<Real>& b) {
  Matrix3<Real> result;
  for (int i = 0; i < 3; ++i) result.col(i) = product(a, Vector3<Real>(b.col(i)));
  return result;
}
template <class Real>
Matrix3<Real> transposed(const Matrix3<Real>& m) {
  return m.transpose();
}

/// Homogeneous transform (thesis equation 1): a rotation matrix and a position in m. Takes coordinates of
/// its own frame to those of the base.
template <class Real>
struct Transform {
  Matrix3<Real> rotation = Matrix3<Real>::Identity();
  Vector3<Real> position_m = Vector3<Real>::Zero();

  Vector3<Real> operator*(const Vector3<Real>& point_m) const {
    return product(rotation, point_m) + position_m;
  }
  Transform operator*(const Transform& next) const {
    return {product(rotation, next.rotation), product(rotation, next.position_m) + position_m};
  }

  [[nodiscard]] Transform inverse() const {
    return {rotation.transpose(), -product(transposed(rotation), position_m)};
  }

  [[nodiscard]] Matrix4<Real> matrix() const {
    Matrix4<Real> m = Matrix4<Real>::Identity();
    m.template topLeftCorner<3, 3>() = rotation;
    m.template topRightCorner<3, 1>() = position_m;
    return m;
  }
};

/// Rotation by an angle in rad about one axis of the base.
template <class Real>
Matrix3<Real> rotation_x(Real angle_rad) {
  const auto [s, c] = math::sin_cos(angle_rad);
  Matrix3<Real> r;
  r << 1, 0, 0, 0, c, -s, 0, s, c;
  return r;
}
template <class Real>
Matrix3<Real> rotation_y(Real angle_rad) {
  const auto [s, c] = math::sin_cos(angle_rad);
  Matrix3<Real> r;
  r << c, 0, s, 0, 1, 0, -s, 0, c;
  return r;
}
template <class Real>
Matrix3<Real> rotation_z(Real angle_rad) {
  const auto [s, c] = math::sin_cos(angle_rad);
  Matrix3<Real> r;
  r << c, -s, 0, s, c, 0, 0, 0, 1;
  return r;
}

/// Rz(yaw) Ry(pitch) Rx(roll) of {roll, pitch, yaw} in rad: turns about the fixed axes x, y, z, in this
/// order.
template <class Real>
Matrix3<Real> rotation_of(const Vector3<Real>& angles_rad) {
  return product(rotation_z(angles_rad(2)), product(rotation_y(angles_rad(1)), rotation_x(angles_rad(0))));
}

/// {roll, pitch, yaw} in rad of a rotation matrix, pitch in -pi/2 .. pi/2. Where pitch is +-pi/2 only the sum
/// or difference of roll and yaw is determined: roll is 0.
template <class Real>
Vector3<Real> angles_of(const Matrix3<Real>& r) {
  const Real cos_pitch = math::sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
  const Real pitch = math::atan2(-r(2, 0), cos_pitch);
  // Beside +-pi/2 roll and yaw are quotients of rounding errors.
  if (!(cos_pitch > Real(8) * Eigen::NumTraits<Real>::epsilon()))
    return {Real(0), pitch, math::atan2(-r(0, 1), r(1, 1))};
  return {math::atan2(r(2, 1), r(2, 2)), pitch, math::atan2(r(1, 0), r(0, 0))};
}

}  // namespace morepro::kinematics
