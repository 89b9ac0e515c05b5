#pragma once
#include <cmath>

#include "lib/math/angle_parts.hpp"
#include "lib/math/float_parts.hpp"

/// Elementary functions. The float overloads use + - * / and bit operations only, so that every machine gives
/// the same bits; each is defined for every argument, branches rarely, and may run in an interrupt. Results
/// below the smallest normal number (1.2e-38) are 0. The double overloads are the standard library's, for
/// comparison on a PC. The relative errors are the largest against those, by the sweeps of the unit test.
namespace morepro::math {

constexpr float abs(float x) { return detail::magnitude(x); }
constexpr double abs(double x) { return __builtin_fabs(x); }

/// e^x; relative error < 3e-7. 0 below -87.3, infinity above 88.3, NaN for NaN. Without a branch: loops of it
/// are vectorised.
constexpr float exp(float x) {
  constexpr float kLowest = -87.3F;
  constexpr float kHighest = 88.3F;
  const float raised = x > kLowest ? x : kLowest;
  const float power = detail::exp_core(raised < kHighest ? raised : kHighest);
  const float bounded = x > kHighest ? detail::kInfinity : power;
  return x >= kLowest ? bounded : (x < kLowest ? 0.0F : detail::kNan);
}
inline double exp(double x) { return std::exp(x); }

/// e^x for x <= 0 without a branch, so that a loop over it can be vectorised; below -86 it stays at e^-86
/// = 4.5e-38.
constexpr float exp_of_nonpositive(float x) { return detail::exp_core(x > -86.0F ? x : -86.0F); }
inline double exp_of_nonpositive(double x) { return std::exp(x); }

/// 2^x; relative error < 5e-7. 0 up to -126, infinity from 128 on, NaN for NaN.
constexpr float exp2(float x) {
  return abs(x) < 125.0F ? detail::exp2_core(x, 0.0F) : detail::exp2_at_limits(x, 0.0F);
}
inline double exp2(double x) { return std::exp2(x); }

/// Natural logarithm; relative error < 4e-7, around 1 too. log(0) is -infinity, NaN for negative numbers and
/// NaN.
constexpr float log(float x) {
  if (detail::is_outside_positive_normal(x)) return detail::log_outside_positive_normal(x);
  return detail::log_of_parts(detail::log2_parts(x));
}
inline double log(double x) { return std::log(x); }

/// The same without a branch, for loops that are to be vectorised: x must be positive and normal, else the
/// value means nothing.
constexpr float log_of_normal(float x) { return detail::log_of_parts(detail::log2_parts(x)); }
inline double log_of_normal(double x) { return std::log(x); }

/// x^y for x >= 0; relative error < 3e-7 for |y| <= 1, growing with |y|. 0^y is 0, 1 or infinity by the sign
/// of y; NaN where x is negative, where an argument is NaN and where y is infinite; infinity^0 is 1.
constexpr float pow(float x, float y) {
  if (detail::is_outside_positive_normal(x)) return detail::pow_outside_positive_normal(x, y);
  return detail::pow_of_parts(detail::log2_parts(x), y);
}
inline double pow(double x, double y) { return std::pow(x, y); }

/// Hyperbolic tangent; relative error < 3e-7, exactly odd, +-1 from |x| = 9.02 on, NaN for NaN.
/// Near 0 the continued fraction of Lambert to its fifth level: its error is 1e-8 at 0.8.
constexpr float tanh(float x) {
  const float size = abs(x);
  if (size < 0.8F) {
    const float z = x * x;
    return x * (945.0F + z * (105.0F + z)) / (945.0F + z * (420.0F + z * 15.0F));
  }
  if (x != x) return detail::kNan;
  const float positive = size < 9.02F ? 1.0F - 2.0F / (detail::exp_core(size + size) + 1.0F) : 1.0F;
  return x < 0.0F ? -positive : positive;
}
/// Not beside 0: faster, to the last bits.
inline double tanh(double x) {
  const double size = abs(x);
  if (size < 0.3) return std::tanh(x);
  const double positive = 1.0 - 2.0 / (std::exp(size + size) + 1.0);
  return x < 0.0 ? -positive : positive;
}

template <class Real>
struct SinCos {
  Real sin;
  Real cos;
};

/// Sine and cosine of an angle in rad, one reduction for both. Error below 1.2e-7 for every finite x;
/// relative error below 2e-7 where |x| <= 100, beside the zeros too. sin is exactly odd, cos exactly even;
/// NaN for infinities and NaN.
constexpr SinCos<float> sin_cos(float x) {
  const auto [quarter, remainder] = detail::quarter_turn(x);
  const float s = detail::sin_core(remainder);
  const float c = detail::cos_core(remainder);
  const bool is_odd = (quarter & 1U) != 0;
  return {detail::with_sign(is_odd ? c : s, (quarter & 2U) != 0),
          detail::with_sign(is_odd ? s : c, ((quarter + 1U) & 2U) != 0)};
}
inline SinCos<double> sin_cos(double x) { return {std::sin(x), std::cos(x)}; }

/// The halves of sin_cos, with its errors.
constexpr float sin(float x) { return sin_cos(x).sin; }
inline double sin(double x) { return std::sin(x); }
constexpr float cos(float x) { return sin_cos(x).cos; }
inline double cos(double x) { return std::cos(x); }

/// Angle of the direction (x, y) in rad, -pi .. pi; error below 3e-7, relative below 3e-7 beside y = 0 and x
/// > 0. Odd in y; 0 for (0, 0), NaN where an argument is infinite or NaN.
constexpr float atan2(float y, float x) {
  const float height = abs(y);
  const float width = abs(x);
  if (!(height - height == 0.0F && width - width == 0.0F)) return detail::kNan;
  if (height == 0.0F && width == 0.0F) return 0.0F;
  const float octant = height <= width ? detail::atan_of_octant(height, width)
                                       : 1.57079633F - detail::atan_of_octant(width, height);
  return detail::with_sign(x < 0.0F ? 3.14159265F - octant : octant, y < 0.0F);
}
inline double atan2(double y, double x) { return std::atan2(y, x); }

/// Square root, correctly rounded; NaN for negative numbers.
inline float sqrt(float x) { return std::sqrt(x); }
inline double sqrt(double x) { return std::sqrt(x); }

}  // namespace morepro::math
