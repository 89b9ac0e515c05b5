#pragma once
#include <array>

#include "lib/kinematics/dh_table.hpp"
#include "lib/kinematics/joint_vector.hpp"
#include "lib/kinematics/transform.hpp"

namespace morepro::kinematics {

/// Geometry of the thesis's machine: link offsets (a1 .. a4 of Table 1) and how far each slide travels from
/// the middle, in m. The thesis gives no values: these are ours.
struct MachineGeometry {
  double a1_m = 0.40;
  double a2_m = 0.10;
  double a3_m = 0.15;
  double a4_m = 0.12;
  double travel_m = 1.0;
};

/// Table 1 of the thesis with joint 2's theta = -90 degrees, the only multiple of 90 degrees with which the
/// table gives the thesis's own transforms T1 .. T3 (equation 2) and its Jacobian (equation 6). Joints: d1,
/// d2, d3 in m, t4 in rad.
constexpr DhTable morepro_table(const MachineGeometry& g = {}) {
  constexpr double kQuarterTurn = 1.57079632679489661923;
  constexpr JointKind kSlide = JointKind::kPrismatic;
  DhTable table{.count = 4};
  table.joints[0] = {kSlide, 0.0, g.a1_m, -kQuarterTurn, 0.0, -g.travel_m, g.travel_m};
  table.joints[1] = {kSlide, 0.0, g.a2_m, -kQuarterTurn, -kQuarterTurn, -g.travel_m, g.travel_m};
  table.joints[2] = {kSlide, 0.0, g.a3_m, 0.0, 0.0, -g.travel_m, g.travel_m};
  table.joints[3] = {JointKind::kRevolute, 0.0, g.a4_m, 0.0, 0.0};
  return table;
}

/// What this machine can place: the tool's position in m and its roll about its own axis, the base's x axis,
/// in rad. It has no tilt: the axis is x for every t4.
template <class Real>
struct RollPose {
  Vector3<Real> position_m = Vector3<Real>::Zero();
  Real roll_rad = 0;
};

/// Closed-form inverse of morepro_table(): d3 = x - a3 - a4, d2 = y - a2, d1 = z - a1, t4 = roll. One
/// solution for every pose, no singularity; the joints' limits are the caller's to check.
template <class Real>
JointVector<Real> inverse_of(const MachineGeometry& geometry, const RollPose<Real>& pose) {
  JointVector<Real> q{};
  q[0] = pose.position_m(2) - Real(geometry.a1_m);
  q[1] = pose.position_m(1) - Real(geometry.a2_m);
  q[2] = pose.position_m(0) - (Real(geometry.a3_m) + Real(geometry.a4_m));
  q[3] = pose.roll_rad;
  return q;
}

/// The same for speeds (m/s, rad/s) or accelerations: the inverse of equation 6 is the matrix itself.
template <class Real>
JointVector<Real> inverse_rates_of(const Vector3<Real>& linear, Real roll_rate) {
  return {linear(2), linear(1), linear(0), roll_rate};
}

}  // namespace morepro::kinematics
