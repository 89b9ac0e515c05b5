#pragma once

namespace morepro::kinematics {

/// How much of a segment has been travelled: a share of 1, its rate in 1/s and the rate's rate in 1/s2.
template <class Real>
struct Progress {
  Real share = 0;
  Real rate = 0;
  Real acceleration = 0;
};

/// The thesis does not say how long its ramps are: a third of the time each, ours.
inline constexpr double kThirdOfTime = 1.0 / 3.0;

/// A segment in less time is a mistake, and its acceleration leaves the range of a float.
inline constexpr double kShortestSegmentS = 1.0e-6;

/// Trapezoidal speed profile: constant acceleration, constant speed, the same deceleration; at rest at both
/// ends.
template <class Real>
class SpeedProfile {
 public:
  /// Both must be possible; see is_possible.
  SpeedProfile(Real duration_s, Real ramp_share)
      : duration_s_(duration_s),
        ramp_s_(duration_s * ramp_share),
        top_rate_(Real(1) / (duration_s - ramp_s_)),
        acceleration_(top_rate_ / ramp_s_) {}

  /// The time is finite and at least kShortestSegmentS, and each ramp takes some of it but not more than
  /// half; NaN is not possible.
  static constexpr bool is_possible(Real duration_s, Real ramp_share) {
    return duration_s >= Real(kShortestSegmentS) && duration_s - duration_s == Real(0) &&
           ramp_share > Real(0) && ramp_share <= Real(0.5);
  }

  [[nodiscard]] Real duration_s() const { return duration_s_; }

  /// At 0 <= t <= duration. At a corner the acceleration is that of the part that begins there, at the very
  /// end the deceleration's. Rest outside.
  [[nodiscard]] Progress<Real> at(Real t_s) const {
    const Real left_s = duration_s_ - t_s;
    if (!(t_s >= Real(0))) return {};
    if (left_s < Real(0)) return {.share = 1};
    if (t_s < ramp_s_) return {acceleration_ * t_s * t_s / Real(2), acceleration_ * t_s, acceleration_};
    if (left_s > ramp_s_) return {top_rate_ * (t_s - ramp_s_ / Real(2)), top_rate_, Real(0)};
    return {Real(1) - acceleration_ * left_s * left_s / Real(2), acceleration_ * left_s, -acceleration_};
  }

 private:
  Real duration_s_;
  Real ramp_s_;
  Real top_rate_;
  Real acceleration_;
};

}  // namespace morepro::kinematics
