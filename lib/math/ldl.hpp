#pragma once
#include <Eigen/Core>

#include "lib/math/elementary.hpp"

namespace morepro::math {

/// S = L D L^T of a small symmetric matrix, without roots. kN: its size. Only the lower triangle of S is
/// read.
template <class Real, int kN>
class Ldl {
 public:
  using Matrix = Eigen::Matrix<Real, kN, kN>;
  using Vector = Eigen::Matrix<Real, kN, 1>;

  explicit Ldl(const Matrix& s) : lower_(Matrix::Identity()) {
    for (int j = 0; j < kN; ++j) {
      pivot_(j) = s(j, j) - weighted_product(j, j, j);
      for (int i = j + 1; i < kN; ++i) lower_(i, j) = (s(i, j) - weighted_product(i, j, j)) / pivot_(j);
    }
  }

  /// All pivots are positive and finite. Nothing else may be asked where this is false.
  [[nodiscard]] bool is_positive() const {
    for (int j = 0; j < kN; ++j) {
      if (!(pivot_(j) > Real(0)) || !(pivot_(j) - pivot_(j) == Real(0))) return false;
    }
    return true;
  }

  /// S^-1 b.
  Vector solve(const Vector& b) const {
    Vector x = b;
    for (int i = 0; i < kN; ++i) {
      for (int j = 0; j < i; ++j) x(i) -= lower_(i, j) * x(j);
    }
    for (int i = 0; i < kN; ++i) x(i) /= pivot_(i);
    for (int i = kN - 1; i >= 0; --i) {
      for (int j = i + 1; j < kN; ++j) x(i) -= lower_(j, i) * x(j);
    }
    return x;
  }

  /// The smallest of the diagonal of D, each times the weight of its row: tells how near S is to a singular
  /// matrix, negative or NaN where rounding has passed it.
  Real smallest_pivot(const Vector& weight) const {
    Real smallest = pivot_(0) * weight(0);
    for (int j = 1; j < kN; ++j) {
      const Real pivot = pivot_(j) * weight(j);
      if (!(pivot >= smallest)) smallest = pivot;
    }
    return smallest;
  }

  /// Natural logarithm of the determinant of S.
  Real log_determinant() const {
    Real sum = 0;
    for (int j = 0; j < kN; ++j) sum += log(pivot_(j));
    return sum;
  }

 private:
  /// Sum over k < end of L(i, k) D(k) L(j, k).
  Real weighted_product(int i, int j, int end) const {
    Real sum = 0;
    for (int k = 0; k < end; ++k) sum += lower_(i, k) * pivot_(k) * lower_(j, k);
    return sum;
  }

  Matrix lower_;
  Vector pivot_;
};

}  // namespace morepro::math
