#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace morepro::kinematics {

enum class JointKind : std::uint8_t { kPrismatic = 0, kRevolute = 1 };

/// One row of a Denavit-Hartenberg table, in the thesis's convention (equation 3): a turn by theta and a
/// shift by d along the axis z of the joint before, then a shift by a and a turn by alpha along the new axis
/// x. The joint's variable, in m or rad, is added to d (prismatic) or theta (revolute). Double precision, so
/// that a table means the same chain on a board and on a PC.
struct DhJoint {
  JointKind kind = JointKind::kPrismatic;
  double a_m = 0.0;
  double d_m = 0.0;
  double alpha_rad = 0.0;
  double theta_rad = 0.0;
  double lowest = -std::numeric_limits<double>::infinity();  ///< of the variable, m or rad
  double highest = std::numeric_limits<double>::infinity();  ///< of the variable, m or rad
};

inline constexpr std::size_t kMaxJoints = 8;

/// Lengths beyond this are a mistake of units.
inline constexpr double kLongestLinkM = 1.0e3;
/// Angles beyond this are degrees.
inline constexpr double kLargestAngleRad = 100.0;

enum class TableError : std::uint8_t {
  kNone = 0,
  kNoJoints = 1,
  kTooManyJoints = 2,
  kUnknownKind = 3,
  kLength = 4,  ///< a or d is not finite or above kLongestLinkM
  kAngle = 5,   ///< alpha or theta is not finite or above kLargestAngleRad
  kLimits = 6,  ///< lowest is not below highest, or one of them is NaN
};

struct TableStatus {
  TableError error = TableError::kNone;
  std::size_t joint = 0;  ///< the first one that is wrong, from 0
  [[nodiscard]] constexpr bool is_good() const { return error == TableError::kNone; }
};

/// A chain as data, from the base to the tool.
struct DhTable {
  std::array<DhJoint, kMaxJoints> joints{};
  std::size_t count = 0;  ///< 1 .. kMaxJoints

  [[nodiscard]] constexpr TableStatus validate() const;
};

namespace detail {

/// NaN is above every limit.
constexpr bool is_within(double x, double largest) { return x >= -largest && x <= largest; }

constexpr TableError check(const DhJoint& joint) {
  if (joint.kind != JointKind::kPrismatic && joint.kind != JointKind::kRevolute)
    return TableError::kUnknownKind;
  if (!is_within(joint.a_m, kLongestLinkM) || !is_within(joint.d_m, kLongestLinkM))
    return TableError::kLength;
  if (!is_within(joint.alpha_rad, kLargestAngleRad) || !is_within(joint.theta_rad, kLargestAngleRad))
    return TableError::kAngle;
  return joint.lowest < joint.highest ? TableError::kNone : TableError::kLimits;
}

}  // namespace detail

constexpr TableStatus DhTable::validate() const {
  if (count == 0) return {TableError::kNoJoints};
  if (count > kMaxJoints) return {TableError::kTooManyJoints};
  for (std::size_t i = 0; i < count; ++i) {
    if (const TableError error = detail::check(joints[i]); error != TableError::kNone) return {error, i};
  }
  return {};
}

}  // namespace morepro::kinematics
