#pragma once
#include "lib/kinematics/chain.hpp"
#include "lib/kinematics/rotation_vector.hpp"
#include "lib/kinematics/speed_profile.hpp"

namespace morepro::kinematics {

/// A point of a path: the tool's position in m, and its roll, pitch and yaw in rad about the base's axes,
/// counted from the orientation that it has at joint values 0.
template <class Real>
struct Waypoint {
  Vector3<Real> position_m = Vector3<Real>::Zero();
  Vector3<Real> angles_rad = Vector3<Real>::Zero();
};

/// Where the tool shall be, how fast, and how it accelerates; m and rad, the base's axes.
template <class Real>
struct ToolState {
  Vector3<Real> position_m = Vector3<Real>::Zero();
  Matrix3<Real> turn = Matrix3<Real>::Identity();    ///< from the orientation at joint values 0
  Vector3<Real> angles_rad = Vector3<Real>::Zero();  ///< of the turn; more than one turn where a path says so
  Twist<Real> speed = Twist<Real>::Zero();
  Twist<Real> acceleration = Twist<Real>::Zero();
};

/// A straight line between two points while the tool turns evenly about one axis.
template <class Real>
class Segment {
 public:
  Segment() : Segment({}, {}, Real(1), Real(kThirdOfTime)) {}
  /// Duration and ramps must be possible for the SpeedProfile.
  Segment(const Waypoint<Real>& from, const Waypoint<Real>& to, Real duration_s, Real ramp_share)
      : start_(from), way_(Twist<Real>::Zero()), profile_(duration_s, ramp_share) {
    const Vector3<Real> change = to.angles_rad - from.angles_rad;
    is_about_one_axis_ = turns_about_one_axis(from.angles_rad, change);
    start_turn_ = rotation_of(from.angles_rad);
    const Vector3<Real> turn =
        is_about_one_axis_ ? change
                           : rotation_vector(product(rotation_of(to.angles_rad), transposed(start_turn_)));
    way_ = twist_of(Vector3<Real>(to.position_m - from.position_m), turn);
  }

  [[nodiscard]] Real duration_s() const { return profile_.duration_s(); }
  /// The whole way: m, and the rotation vector in rad.
  [[nodiscard]] const Twist<Real>& way() const { return way_; }

  [[nodiscard]] ToolState<Real> at(Real t_s) const {
    const Progress<Real> progress = profile_.at(t_s);
    ToolState<Real> state;
    const Vector3<Real> turned = way_.template tail<3>() * progress.share;
    state.position_m = start_.position_m + way_.template head<3>() * progress.share;
    state.turn = product(rotation_about(turned), start_turn_);
    state.angles_rad = is_about_one_axis_ ? Vector3<Real>(start_.angles_rad + turned) : angles_of(state.turn);
    state.speed = way_ * progress.rate;
    state.acceleration = way_ * progress.acceleration;
    return state;
  }

 private:
  /// One angle alone changes and is the turn about its axis: then it may be more than half a turn.
  static bool turns_about_one_axis(const Vector3<Real>& from, const Vector3<Real>& change) {
    const bool rolls = change(0) != Real(0);
    const bool pitches = change(1) != Real(0);
    const bool yaws = change(2) != Real(0);
    if (rolls) return !pitches && !yaws && from(1) == Real(0) && from(2) == Real(0);
    return pitches ? !yaws && from(2) == Real(0) : true;
  }

  Waypoint<Real> start_;
  Twist<Real> way_;
  SpeedProfile<Real> profile_;
  Matrix3<Real> start_turn_;
  bool is_about_one_axis_ = true;
};

}  // namespace morepro::kinematics
