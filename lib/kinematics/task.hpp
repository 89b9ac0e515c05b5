#pragma once
#include <cstdint>

#include "lib/kinematics/chain.hpp"
#include "lib/kinematics/rotation_vector.hpp"

namespace morepro::kinematics {

/// Which of x, y, z, wx, wy, wz a chain is asked to follow, as bits from the lowest. What is not asked for is
/// free.
using TaskRows = std::uint8_t;
inline constexpr TaskRows kPositionRows = 0b000111;
inline constexpr TaskRows kRollRows = 0b001111;  ///< the thesis's reduced form
inline constexpr TaskRows kAngleRows = 0b111000;
inline constexpr TaskRows kAllRows = 0b111111;

constexpr bool has_row(TaskRows rows, int row) { return ((rows >> row) & 1) != 0; }

/// Wanted minus actual: m, and the rotation vector in rad that turns the actual orientation into the wanted
/// one, at most half a turn. Rows that are not asked for are 0.
template <class Real>
Twist<Real> task_error(TaskRows rows, const Vector3<Real>& position_m, const Matrix3<Real>& rotation,
                       const Transform<Real>& tool) {
  Twist<Real> error = Twist<Real>::Zero();
  error.template head<3>() = position_m - tool.position_m;
  if ((rows & kAngleRows) != 0) {
    error.template tail<3>() = rotation_vector(product(rotation, transposed(tool.rotation)));
  }
  for (int row = 0; row < 6; ++row) {
    if (!has_row(rows, row)) error(row) = Real(0);
  }
  return error;
}

}  // namespace morepro::kinematics
