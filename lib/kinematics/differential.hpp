#pragma once
#include "lib/kinematics/chain.hpp"

namespace morepro::kinematics {

/// Speed of the tool, m/s and rad/s (equation 7): J q'.
template <class Real>
Twist<Real> tool_speed(const Chain<Real>& chain, const Jacobian<Real>& j, const JointVector<Real>& rate) {
  Twist<Real> v = Twist<Real>::Zero();
  for (std::size_t i = 0; i < chain.count(); ++i) v += j.col(static_cast<int>(i)) * rate[i];
  return v;
}

/// J' q': the tool's acceleration, m/s2 and rad/s2, when no joint accelerates. With it x'' = J q'' + J' q'.
template <class Real>
Twist<Real> rate_of_jacobian_times_rate(const Chain<Real>& chain, const ChainFrames<Real>& frames,
                                        const JointVector<Real>& rate) {
  // From the base outwards: speed and acceleration of every frame's origin, as in a Newton-Euler recursion.
  Vector3<Real> w = Vector3<Real>::Zero();
  Vector3<Real> w_rate = Vector3<Real>::Zero();
  Vector3<Real> acceleration = Vector3<Real>::Zero();
  for (std::size_t i = 0; i < chain.count(); ++i) {
    const Vector3<Real> moved = frames.axis(i) * rate[i];
    const Vector3<Real> link = frames.frame[i + 1].position_m - frames.frame[i].position_m;
    if (chain.is_revolute(i)) {
      w_rate += cross(w, moved);
      w += moved;
    } else {
      acceleration += Real(2) * cross(w, moved);
    }
    acceleration += cross(w_rate, link) + cross(w, cross(w, link));
  }
  return twist_of(acceleration, w_rate);
}

}  // namespace morepro::kinematics
