#pragma once
#include <array>
#include <cstddef>

namespace morepro {

/// Covariance P = U D U' of a state whose first kDynamic elements move and whose last kN - kDynamic elements
/// are parameters that stay (up to a small drift). U is unit upper triangular, D diagonal. Positive by
/// construction, so it survives float32 without excitation, where Joseph's form does not. Source: Bierman,
/// Factorization Methods for Discrete Sequential Estimation (1977), chapters III, V and VI; the prediction
/// uses that the rows of the parameters do not change.
template <class Real, std::size_t kN, std::size_t kDynamic = 2>
class UdCovariance {
  static_assert(kDynamic == 2 && kN >= kDynamic);

 public:
  static constexpr std::size_t kParameters = kN - kDynamic;
  using Vector = std::array<Real, kN>;
  using Parameters = std::array<Real, kParameters>;

  /// Diagonal covariance.
  explicit UdCovariance(const Vector& variance) { restart(variance); }
  void restart(const Vector& variance) {
    d_ = variance;
    for (std::size_t i = 0; i < kN; ++i)
      for (std::size_t j = 0; j < kN; ++j) u_[i][j] = i == j ? Real(1) : Real(0);
  }

  /// P <- [[F, G], [0, I]] P [[F, G], [0, I]]' + diag(q, 0). Row r of F and of G belongs to moving element r.
  void predict(const std::array<std::array<Real, 2>, 2>& f, const std::array<Parameters, 2>& g,
               const std::array<Real, 2>& q) {
    predict_tail(f, g);
    predict_head(f, q);
  }

  /// P <- P + q a a' with q >= 0 (Agee and Turner); `last`: index of the last element of `a` that is not
  /// zero.
  void add_rank_one(Vector a, std::size_t last, Real q) {
    for (std::size_t k = last + 1; k-- > 0;) {
      const Real before = d_[k];
      const Real c = a[k];
      d_[k] = before + q * c * c;
      const Real inverse = d_[k] > Real(0) ? Real(1) / d_[k] : Real(0);
      const Real b = q * c * inverse;
      for (std::size_t i = 0; i < k; ++i) {
        a[i] -= c * u_[i][k];
        u_[i][k] += b * a[i];
      }
      q *= before * inverse;
    }
  }

  /// P_jj <- P_jj + q, q >= 0.
  void add_variance(std::size_t j, Real q) {
    Vector unit{};
    unit[j] = Real(1);
    add_rank_one(unit, j, q);
  }

  /// What a scalar measurement of one element gave: x <- x + gain * innovation.
  struct Update {
    Vector gain;
    Real innovation_variance;
  };

  /// Bierman's update with y = x_h + noise of `variance` > 0.
  template <std::size_t h>
  Update update(Real variance) {
    Update result{};
    // The first column: the diagonal of U is 1, and nothing has been gained before it.
    for (std::size_t i = 0; i < h; ++i) result.gain[i] = d_[h] * u_[i][h];
    result.gain[h] = d_[h];
    Real alpha = variance + d_[h];
    Real inverse = Real(1) / alpha;
    d_[h] *= variance * inverse;
#pragma GCC unroll 8
    for (std::size_t j = h + 1; j < kN; ++j) {
      const Real f = u_[h][j];
      const Real v = d_[j] * f;
      const Real before = alpha;
      const Real lambda = -f * inverse;
      alpha += f * v;
      inverse = Real(1) / alpha;
      d_[j] *= before * inverse;
#pragma GCC unroll 8
      for (std::size_t i = 0; i < j; ++i) {
        const Real u = u_[i][j];
        u_[i][j] = u + lambda * result.gain[i];
        result.gain[i] += v * u;
      }
      result.gain[j] = v;
    }
    result.innovation_variance = alpha;
    for (std::size_t i = 0; i < kN; ++i) result.gain[i] *= inverse;
    return result;
  }

  /// Element (i, j) of P.
  [[nodiscard]] Real covariance(std::size_t i, std::size_t j) const {
    Real sum{};
    for (std::size_t k = i > j ? i : j; k < kN; ++k) sum += u_[i][k] * u_[j][k] * d_[k];
    return sum;
  }
  [[nodiscard]] Real variance(std::size_t i) const { return covariance(i, i); }

  /// Element j is known with `variance` and correlated with nothing from now on.
  void restart(std::size_t j, Real variance) {
    // What column j carried of the elements above is part of their covariance and stays with them.
    Vector carried{};
    for (std::size_t i = 0; i < j; ++i) {
      carried[i] = u_[i][j];
      u_[i][j] = Real(0);
    }
    if (j > 0) add_rank_one(carried, j - 1, d_[j]);
    for (std::size_t k = j + 1; k < kN; ++k) u_[j][k] = Real(0);
    d_[j] = variance;
  }

 private:
  /// U_sp <- F U_sp + G U_pp: the parameters' rows are already orthogonal, so this is all that couples them.
  void predict_tail(const std::array<std::array<Real, 2>, 2>& f, const std::array<Parameters, 2>& g) {
#pragma GCC unroll 8
    for (std::size_t j = kDynamic; j < kN; ++j) {
      Real from0 = f[0][0] * u_[0][j] + f[0][1] * u_[1][j];
      Real from1 = f[1][0] * u_[0][j] + f[1][1] * u_[1][j];
#pragma GCC unroll 8
      for (std::size_t k = kDynamic; k < j; ++k) {
        from0 += g[0][k - kDynamic] * u_[k][j];
        from1 += g[1][k - kDynamic] * u_[k][j];
      }
      u_[0][j] = from0 + g[0][j - kDynamic];
      u_[1][j] = from1 + g[1][j - kDynamic];
    }
  }

  /// Weighted Gram-Schmidt of the two rows [F U_ss, I] with weights [D_s, q]: sums of positive terms only.
  void predict_head(const std::array<std::array<Real, 2>, 2>& f, const std::array<Real, 2>& q) {
    const Real r00 = f[0][0], r01 = f[0][0] * u_[0][1] + f[0][1];
    const Real r10 = f[1][0], r11 = f[1][0] * u_[0][1] + f[1][1];
    const Real w0 = r10 * d_[0], w1 = r11 * d_[1];
    const Real d1 = r10 * w0 + r11 * w1 + q[1];
    const Real u = d1 > Real(0) ? (r00 * w0 + r01 * w1) / d1 : Real(0);
    const Real s0 = r00 - u * r10, s1 = r01 - u * r11;
    d_[0] = s0 * s0 * d_[0] + s1 * s1 * d_[1] + q[0] + u * u * q[1];
    d_[1] = d1;
    u_[0][1] = u;
  }

  std::array<Vector, kN> u_{};
  Vector d_;
};

}  // namespace morepro
