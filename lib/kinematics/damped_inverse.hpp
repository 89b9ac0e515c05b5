#pragma once
#include "lib/kinematics/mobility.hpp"
#include "lib/math/ldl.hpp"

namespace morepro::kinematics {

/// Below this share of the largest diagonal of J J^T its smallest pivot counts as singular, each in units of
/// what is typical of its row: a singular value of about 3 % of the largest.
inline constexpr double kSingularShare = 1.0e-3;

/// q' = J^T (J J^T + lambda D)^-1 v over the directions of a task in which the chain moves at all: the exact
/// inverse, of least norm where joints are to spare, away from singularities; damped beside them, so that no
/// joint runs away. D: typical squares of the rows. lambda grows from 0 where the smallest pivot of J J^T
/// falls below kSingularShare of its largest diagonal (Nakamura and Hanafusa). A search that takes less of it
/// the nearer it comes (`damping_share`, above 0, at most 1) converges at a singularity, too.
template <class Real>
class DampedInverse {
 public:
  using Matrix6 = Eigen::Matrix<Real, 6, 6>;

  DampedInverse(const Mobility<Real>& mobility, std::size_t joints, const Jacobian<Real>& jacobian,
                Real damping_share = 1)
      : jacobian_(jacobian), joints_(joints), damping_(0), factors_(damped(mobility, damping_share)) {}

  [[nodiscard]] Real damping() const { return damping_; }

  /// Rates for a speed of the tool whose rows outside the task are 0. A speed along a still direction moves
  /// nothing.
  [[nodiscard]] JointVector<Real> rates(const Twist<Real>& speed) const {
    const Twist<Real> weights = factors_.solve(speed);
    JointVector<Real> rate{};
    for (std::size_t i = 0; i < joints_; ++i)
      rate[i] = dot(Twist<Real>(jacobian_.col(static_cast<int>(i))), weights);
    return rate;
  }

 private:
  math::Ldl<Real, 6> damped(const Mobility<Real>& mobility, Real damping_share) {
    Matrix6 square = square_of(mobility.rows());
    Real largest = 0;
    for (int r = 0; r < 6; ++r) {
      const Real relative = square(r, r) * mobility.per_typical_square()(r);
      largest = relative > largest ? relative : largest;
    }
    // A chain that cannot move at all must not divide by 0.
    const Real neutral = largest > Real(0) ? largest : Real(1);
    // What never moves must not look singular. J^T is 0 along it, so what is filled in moves no joint.
    mobility.add_still(neutral, square);
    const math::Ldl<Real, 6> exact(square);
    const Real threshold = Real(kSingularShare) * neutral;
    const Real pivot = exact.smallest_pivot(mobility.per_typical_square());
    if (pivot >= threshold) return exact;
    const Real lack = pivot > Real(0) ? Real(1) - pivot / threshold : Real(1);
    damping_ = damping_share * threshold * lack * lack;
    for (int r = 0; r < 6; ++r) square(r, r) += damping_ * mobility.typical_square()(r);
    return math::Ldl<Real, 6>(square);
  }

  /// Lower triangle of J J^T over the task's rows. A loop of its own: Eigen's product allocates at this size.
  Matrix6 square_of(TaskRows rows) const {
    Matrix6 square = Matrix6::Zero();
    for (int r = 0; r < 6; ++r) {
      if (!has_row(rows, r)) continue;
      for (int s = 0; s <= r; ++s) {
        if (has_row(rows, s)) square(r, s) = row_product(r, s);
      }
    }
    return square;
  }

  Real row_product(int r, int s) const {
    Real sum = 0;
    for (std::size_t i = 0; i < joints_; ++i)
      sum += jacobian_(r, static_cast<int>(i)) * jacobian_(s, static_cast<int>(i));
    return sum;
  }

  Jacobian<Real> jacobian_;
  std::size_t joints_;
  Real damping_;
  math::Ldl<Real, 6> factors_;
};

}  // namespace morepro::kinematics
