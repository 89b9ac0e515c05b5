#pragma once
#include <array>
#include <cstddef>

namespace morepro {

/// Covariance P = U D U' of kN parameters that stand still, measured by scalars y = h' theta + noise.
/// Positive by construction, as UdCovariance, and of the smallest size: kN (kN + 1)/2 numbers. Source:
/// Bierman (1977), chapters III and V. Bounded time, no state beyond P.
template <class Real, std::size_t kN>
class UdBlock {
 public:
  using Vector = std::array<Real, kN>;
  using Matrix = std::array<Vector, kN>;

  /// Diagonal covariance, variances >= 0.
  explicit UdBlock(const Vector& variance) : d_(variance) {}

  /// The factors of a symmetric P with positive pivots; only its upper triangle is read.
  static UdBlock of(Matrix p) {
    UdBlock ud{Vector{}};
    for (std::size_t j = kN; j-- > 0;) {
      ud.d_[j] = p[j][j];
      for (std::size_t i = 0; i < j; ++i) ud.u_[place(i, j)] = p[i][j] / p[j][j];
      for (std::size_t k = 0; k < j; ++k)
        for (std::size_t i = 0; i <= k; ++i) p[i][k] -= ud.u_[place(i, j)] * p[k][j];
    }
    return ud;
  }

  /// What a scalar measurement gave: theta <- theta + direction * (innovation / innovation_variance).
  struct Update {
    Vector direction;  ///< P h before the update
    Real innovation_variance;
    Real inverse_variance;  ///< 1 / innovation_variance: the update had to divide anyway
  };

  /// Bierman's update with y = h' theta + noise of `variance` > 0.
  Update update(const Vector& h, Real variance) {
    // The first column divides its variance itself, which spares the reciprocal: gain = direction / alpha.
    Vector direction{d_[0] * h[0]};
    Real alpha = variance + h[0] * direction[0];
    const Real share = d_[0] / alpha;
    d_[0] = share * variance;
    Vector gain{share * h[0]};
    Real inverse = Real(1);  // what `gain` is still to be multiplied by
#pragma GCC unroll 8
    for (std::size_t j = 1; j < kN; ++j) {
      Real f = h[j];
#pragma GCC unroll 8
      for (std::size_t i = 0; i < j; ++i) f += u_[place(i, j)] * h[i];
      const Real v = d_[j] * f;
      const Real before = alpha;
      const Real lambda = f * inverse;
      alpha += f * v;
      inverse = Real(1) / alpha;
      d_[j] *= before * inverse;
#pragma GCC unroll 8
      for (std::size_t i = 0; i < j; ++i) {
        const Real u = u_[place(i, j)];
        direction[i] += v * u;
        u_[place(i, j)] = u - lambda * gain[i];
      }
      direction[j] = v;
      gain = direction;
    }
    return {direction, alpha, inverse};
  }

  /// h' P h.
  [[nodiscard]] Real variance_along(const Vector& h) const {
    Real sum{};
    for (std::size_t j = 0; j < kN; ++j) {
      Real f = h[j];
      for (std::size_t i = 0; i < j; ++i) f += u_[place(i, j)] * h[i];
      sum += d_[j] * f * f;
    }
    return sum;
  }

  /// P_jj <- P_jj + q, q >= 0 (Agee and Turner).
  void add_variance(std::size_t parameter, Real q) {
    Vector a{};
    a[parameter] = Real(1);
    for (std::size_t k = parameter + 1; k-- > 0;) {
      const Real before = d_[k], c = a[k];
      d_[k] = before + q * c * c;
      const Real inverse = d_[k] > Real(0) ? Real(1) / d_[k] : Real(0);
      const Real b = q * c * inverse;
      for (std::size_t i = 0; i < k; ++i) {
        a[i] -= c * u_[place(i, k)];
        u_[place(i, k)] += b * a[i];
      }
      q *= before * inverse;
    }
  }

  /// Element (i, j) of P.
  [[nodiscard]] Real covariance(std::size_t i, std::size_t j) const {
    Real sum{};
    for (std::size_t k = i > j ? i : j; k < kN; ++k) sum += u(i, k) * u(j, k) * d_[k];
    return sum;
  }

 private:
  static constexpr std::size_t place(std::size_t row, std::size_t column) {
    return column * (column - 1) / 2 + row;  // row < column
  }
  [[nodiscard]] Real u(std::size_t i, std::size_t k) const { return i == k ? Real(1) : u_[place(i, k)]; }

  Vector d_;
  std::array<Real, kN*(kN - 1) / 2> u_{};
};

}  // namespace morepro
