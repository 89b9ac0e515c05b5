#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lib/math/ldl.hpp"

namespace morepro {

/// What a window of frames tells about the parameters of one balance: Fisher information of their logarithms,
/// so that 1/sqrt(information) is a relative standard error. A window without information on a parameter, or
/// on a combination, says so whatever a filter's covariance claims.
template <class Real, std::size_t kN>
class InformationWindow {
 public:
  using Row = std::array<Real, kN>;

  /// One frame: the slopes of the balance by the logarithms of the parameters, and 1/variance of its
  /// measurement.
  void take(const Row& slope, Real inverse_variance) {
    for (std::size_t i = 0; i < kN; ++i)
      for (std::size_t j = i; j < kN; ++j) now_[i][j] += slope[i] * slope[j] * inverse_variance;
    ++frames_;
  }

  [[nodiscard]] std::size_t frames() const { return frames_; }

  /// Ends the window; the questions below are about the one that ended last.
  void close() {
    last_ = now_;
    now_ = {};
    frames_ = 0;
  }

  /// Information on a parameter where all others of its balance are known.
  [[nodiscard]] Real each(std::size_t j) const { return last_[j][j]; }

  /// Information on a parameter where nothing is known of the others: 1/(J^-1)_jj. Below `each` as far as
  /// they are correlated.
  [[nodiscard]] Real alone(std::size_t j) const {
    constexpr int kSize = static_cast<int>(kN);
    Eigen::Matrix<Real, kSize, kSize> j_matrix;
    for (std::size_t r = 0; r < kN; ++r)
      for (std::size_t c = 0; c < kN; ++c)
        j_matrix(static_cast<int>(r), static_cast<int>(c)) = r <= c ? last_[r][c] : last_[c][r];
    // A datasheet that is known to a factor of e keeps the inverse finite, and takes nothing that matters
    // away. Where the information itself is so large that rounding hides one e, the ridge is as large as the
    // rounding.
    Real largest = Real(1);
    for (std::size_t r = 0; r < kN; ++r) largest = last_[r][r] > largest ? last_[r][r] : largest;
    const Real ridge = largest > Real(kRounding) ? largest / Real(kRounding) : Real(1);
    for (int r = 0; r < kSize; ++r) j_matrix(r, r) += ridge;
    const math::Ldl<Real, kSize> factors(j_matrix);
    if (!factors.is_positive()) return Real(0);
    const auto column = factors.solve(Eigen::Matrix<Real, kSize, 1>::Unit(static_cast<int>(j)));
    const Real information = Real(1) / column(static_cast<int>(j)) - ridge;
    return information > ridge ? information : Real(0);
  }

  /// The parameter of the same balance that j is most correlated with in this window, j itself where there is
  /// none.
  [[nodiscard]] std::size_t partner(std::size_t j) const {
    std::size_t nearest = j;
    Real most = Real(0);
    for (std::size_t k = 0; k < kN; ++k) {
      const Real joint = j < k ? last_[j][k] : last_[k][j];
      const Real product = last_[j][j] * last_[k][k];
      if (k == j || !(product > Real(0)) || !(joint * joint > most * product)) continue;
      most = joint * joint / product;
      nearest = k;
    }
    return nearest;
  }

 private:
  static constexpr double kRounding = 1.0e5;  // float32 keeps seven digits, sums of thousands of frames five

  std::array<Row, kN> now_{};  ///< upper triangles
  std::array<Row, kN> last_{};
  std::size_t frames_ = 0;
};

}  // namespace morepro
