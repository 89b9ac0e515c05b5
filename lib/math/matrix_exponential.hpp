#pragma once
#include <cstddef>
#include <type_traits>

namespace morepro::math {

/// A real 2x2 matrix, by rows.
template <class Real>
struct BasicMatrix2 {
  Real a00 = 0;
  Real a01 = 0;
  Real a10 = 0;
  Real a11 = 0;

  friend constexpr BasicMatrix2 operator*(const BasicMatrix2& a, const BasicMatrix2& b) {
    return {a.a00 * b.a00 + a.a01 * b.a10, a.a00 * b.a01 + a.a01 * b.a11,  //
            a.a10 * b.a00 + a.a11 * b.a10, a.a10 * b.a01 + a.a11 * b.a11};
  }
  friend constexpr BasicMatrix2 operator*(const BasicMatrix2& a, Real s) {
    return {a.a00 * s, a.a01 * s, a.a10 * s, a.a11 * s};
  }
  /// The sum with s times the identity.
  [[nodiscard]] constexpr BasicMatrix2 plus_identity(Real s = 1) const {
    return {a00 + s, a01, a10, a11 + s};
  }
};

/// What a constant linear system x' = A x + b does in h: x(h) = exp * x(0) + integral * b.
template <class Real>
struct BasicExponentialStep2 {
  BasicMatrix2<Real> exp;       ///< exp(A h)
  BasicMatrix2<Real> integral;  ///< integral of exp(A s) over s = 0 .. h
};

using Matrix2 = BasicMatrix2<double>;
using ExponentialStep2 = BasicExponentialStep2<double>;

namespace detail {

template <class Real>
constexpr Real absolute(Real x) {
  return x < 0 ? -x : x;
}

/// Largest absolute row sum.
template <class Real>
constexpr Real row_sum_norm(const BasicMatrix2<Real>& a) {
  const Real first = absolute(a.a00) + absolute(a.a01);
  const Real second = absolute(a.a10) + absolute(a.a11);
  return first > second ? first : second;
}

/// Terms of the series of the integral after which the rest is below one rounding, for |A h| <= 1/2:
/// 0.5^14/15! = 5e-17, 0.5^7/8! = 2e-7 / 2^3 = 2e-8.
template <class Real>
inline constexpr int kSeriesTerms = std::is_same_v<Real, double> ? 14 : 7;

/// Beyond this many doublings |A h| is above 1e15: no step, a mistake.
inline constexpr int kMostDoublings = 50;

}  // namespace detail

/// exp(A h) and its integral by the Taylor series of a step that is halved until |A h| <= 1/2, doubled again.
/// + - * / only: the same bits on every machine. Error in double below 1e-14 of |exp(A h)| (and h for the
/// integral) for |A h| <= 10, growing with |A h|; float: 1e-6. NaN where a or h is not finite.
template <class Real>
[[gnu::noinline]] constexpr BasicExponentialStep2<Real> exponential_step(const BasicMatrix2<Real>& a,
                                                       std::type_identity_t<Real> h) {
  int doublings = 0;
  for (Real norm = detail::row_sum_norm(a) * detail::absolute(h);
       norm > Real(0.5) && doublings < detail::kMostDoublings; norm *= Real(0.5)) {
    h *= Real(0.5);
    ++doublings;
  }
  const BasicMatrix2<Real> z = a * h;
  BasicMatrix2<Real> series = BasicMatrix2<Real>{}.plus_identity();
#pragma GCC unroll 1  // in double, without a unit for it, the series unrolled is 4 KB of calls
  for (int k = detail::kSeriesTerms<Real> + 1; k >= 2; --k)
    series = (z * series * (Real(1) / Real(k))).plus_identity();

  BasicExponentialStep2<Real> step{(z * series).plus_identity(), series * h};
  for (; doublings > 0; --doublings) {
    step.integral = step.integral * step.exp.plus_identity();
    step.exp = step.exp * step.exp;
  }
  return step;
}

}  // namespace morepro::math
