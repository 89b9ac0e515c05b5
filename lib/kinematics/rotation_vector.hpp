#pragma once
#include "lib/kinematics/transform.hpp"

namespace morepro::kinematics {

/// Rotation about the direction of `vector_rad` by its length.
template <class Real>
Matrix3<Real> rotation_about(const Vector3<Real>& vector_rad) {
  const Real angle = math::sqrt(dot(vector_rad, vector_rad));
  if (!(angle > Real(0))) return Matrix3<Real>::Identity();
  const Vector3<Real> k = vector_rad / angle;
  const auto [s, c] = math::sin_cos(angle);
  const Vector3<Real> turned = k * (Real(1) - c);
  Matrix3<Real> r;
  r << turned(0) * k(0) + c, turned(0) * k(1) - s * k(2), turned(0) * k(2) + s * k(1),
      turned(1) * k(0) + s * k(2), turned(1) * k(1) + c, turned(1) * k(2) - s * k(0),
      turned(2) * k(0) - s * k(1), turned(2) * k(1) + s * k(0), turned(2) * k(2) + c;
  return r;
}

namespace detail {

/// Axis of a turn near half a turn, whose skew part vanishes: the longest column of k k^T, which is the
/// symmetric part without its multiple of I.
template <class Real>
Vector3<Real> axis_near_half_turn(const Matrix3<Real>& r, Real cos_angle) {
  const Matrix3<Real> square = (r + r.transpose()) * Real(0.5) - Matrix3<Real>::Identity() * cos_angle;
  int longest = 0;
  for (int i = 1; i < 3; ++i) {
    if (square(i, i) > square(longest, longest)) longest = i;
  }
  const Vector3<Real> column = square.col(longest);
  return column / math::sqrt(dot(column, column));
}

}  // namespace detail

/// The inverse of rotation_about: axis times angle, the angle in 0 .. pi rad.
template <class Real>
Vector3<Real> rotation_vector(const Matrix3<Real>& r) {
  const Vector3<Real> skew(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  const Real twice_sin = math::sqrt(dot(skew, skew));
  const Real twice_cos = (r(0, 0) + r(1, 1) + r(2, 2)) - Real(1);
  const Real angle = math::atan2(twice_sin, twice_cos);
  if (twice_cos > Real(-1.9)) {
    // Where both vanish the angle and its sine are one.
    return twice_sin > Real(0) ? Vector3<Real>(skew * (angle / twice_sin)) : Vector3<Real>(skew * Real(0.5));
  }
  const Vector3<Real> vector = detail::axis_near_half_turn(r, twice_cos * Real(0.5)) * angle;
  return dot(vector, skew) < Real(0) ? Vector3<Real>(-vector) : vector;
}

}  // namespace morepro::kinematics
