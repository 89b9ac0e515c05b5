#pragma once
#include "lib/kinematics/damped_inverse.hpp"
#include "lib/kinematics/segment.hpp"

namespace morepro::kinematics {

template <class Real>
struct PoseSearchResult {
  JointVector<Real> joints{};
  Twist<Real> error = Twist<Real>::Zero();  ///< what is left, m and rad
  bool is_reached = false;                  ///< the error is within the tolerance, the joints in their limits
};

/// Joint values for one pose of any chain, from a start: damped Newton steps, bounded in length, held inside
/// the joints' limits. At most kMostSteps; reaches one solution near the start, or says what is left.
template <class Real>
class PoseSearch {
 public:
  static constexpr int kMostSteps = 200;

  PoseSearch(const Chain<Real>& chain, TaskRows rows, Real tolerance)
      : chain_(chain),
        mobility_(chain, rows),
        tolerance_(tolerance),
        home_(chain.frames({}).tool().rotation) {}

  [[nodiscard]] PoseSearchResult<Real> find(const Waypoint<Real>& pose,
                                            const JointVector<Real>& start) const {
    const Matrix3<Real> rotation = product(rotation_of(pose.angles_rad), home_);
    PoseSearchResult<Real> result{.joints = inside_limits(start)};
    for (int step = 0; step < kMostSteps; ++step) {
      const ChainFrames<Real> frames = chain_.frames(result.joints);
      result.error = task_error(mobility_.rows(), pose.position_m, rotation, frames.tool());
      const Real left = math::sqrt(dot(result.error, result.error));
      result.is_reached = left <= tolerance_;
      if (result.is_reached) break;
      const Real share = left < Real(kDampedFrom) ? left / Real(kDampedFrom) : Real(1);
      const DampedInverse<Real> inverse(mobility_, chain_.count(), chain_.jacobian(frames), share);
      result.joints = moved(result.joints, inverse.rates(result.error));
    }
    return result;
  }

 private:
  /// A longer step leaves the neighbourhood in which the Jacobian means anything.
  static constexpr double kLongestTurnRad = 0.5;
  /// From this error on (m, rad) singularities are damped fully.
  static constexpr double kDampedFrom = 0.1;

  JointVector<Real> moved(JointVector<Real> q, const JointVector<Real>& change) const {
    Real longest = 0;
    for (std::size_t i = 0; i < chain_.count(); ++i) {
      const Real size = math::abs(change[i]);
      if (chain_.is_revolute(i) && size > longest) longest = size;
    }
    const Real scale = longest > Real(kLongestTurnRad) ? Real(kLongestTurnRad) / longest : Real(1);
    for (std::size_t i = 0; i < chain_.count(); ++i) q[i] += scale * change[i];
    return inside_limits(q);
  }

  JointVector<Real> inside_limits(JointVector<Real> q) const {
    for (std::size_t i = 0; i < chain_.count(); ++i) {
      if (q[i] < chain_.lowest(i)) q[i] = chain_.lowest(i);
      if (q[i] > chain_.highest(i)) q[i] = chain_.highest(i);
    }
    return q;
  }

  Chain<Real> chain_;
  Mobility<Real> mobility_;
  Real tolerance_;
  Matrix3<Real> home_;
};

}  // namespace morepro::kinematics
