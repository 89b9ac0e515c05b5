#pragma once
#include <bit>
#include <cstdint>
#include <limits>

/// Building blocks of elementary.hpp: polynomials on reduced arguments, fitted for the smallest largest
/// relative error (Remez exchange in 40 decimal digits, coefficients then rounded to float).
namespace morepro::math::detail {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kSmallestNormal = std::numeric_limits<float>::min();

/// Adding and subtracting 1.5 * 2^23 rounds to an integer, and leaves that integer in the low bits of the
/// sum: no float-to-integer conversion, hence none that can overflow.
inline constexpr float kRoundToInteger = 12582912.0F;

constexpr float magnitude(float x) { return __builtin_fabsf(x); }

/// True for what log2_parts does not take: zero, subnormal, negative, infinite, NaN. One comparison.
constexpr bool is_outside_positive_normal(float x) {
  return std::bit_cast<std::uint32_t>(x) - 0x00800000U >= 0x7F000000U;
}

/// log2(x) = exponent + fraction: a whole number and a remainder in [-0.5, 0.5].
struct Log2Parts {
  float exponent;
  float fraction;
};

/// x: positive and normal. The fraction's approximation error is below 1.2e-7 of its value, so that
/// logarithms keep their relative precision around 1.
constexpr Log2Parts log2_parts(float x) {
  constexpr std::uint32_t kSqrtHalfBits = 0x3F3504F3U;
  const std::uint32_t offset = std::bit_cast<std::uint32_t>(x) - kSqrtHalfBits;
  const float exponent = static_cast<float>(static_cast<std::int32_t>(offset) >> 23);
  const float mantissa = std::bit_cast<float>((offset & 0x007FFFFFU) + kSqrtHalfBits);
  const float f = mantissa - 1.0F;
  const float s = f / (f + 2.0F);
  const float z = s * s;
  const float series = 2.88539052F + z * (0.961588323F + z * 0.59578073F);
  return {exponent, s * series};
}

/// The same for a positive subnormal number.
constexpr Log2Parts log2_parts_of_subnormal(float x) {
  const Log2Parts parts = log2_parts(x * 16777216.0F);
  return {parts.exponent - 24.0F, parts.fraction};
}

/// 2^(n + u) for shifted = n + kRoundToInteger, -125 <= n <= 127, u in [-0.51, 0.51]. Approximation error
/// below 9.2e-8.
constexpr float scaled_exp2(float shifted, float u) {
  const float series =
      1.0F + u * (0.693147004F +
                  u * (0.240222424F + u * (0.0555073358F + u * (0.00967151299F + u * 0.00132647273F))));
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(series) +
                              (std::bit_cast<std::uint32_t>(shifted) << 23));
}

/// 2^(coarse + fine) for |coarse + fine| <= 125. In two parts, because a float near 100 has no bits left for
/// the seventh digit of the result; fine is best below 1.
constexpr float exp2_core(float coarse, float fine) {
  const float shifted = (coarse + fine) + kRoundToInteger;
  return scaled_exp2(shifted, (coarse - (shifted - kRoundToInteger)) + fine);
}

/// 2^(coarse + fine) where the result leaves the range of exp2_core.
[[gnu::noinline, gnu::cold]] constexpr float exp2_at_limits(float coarse, float fine) {
  const float sum = coarse + fine;
  if (sum >= 128.0F) return kInfinity;
  if (sum <= -126.0F) return 0.0F;
  if (sum != sum) return kNan;
  const float root = exp2_core(0.5F * coarse, 0.5F * fine);
  return root * root;
}

constexpr float exp2_of_parts(float coarse, float fine) {
  return magnitude(coarse + fine) < 125.0F ? exp2_core(coarse, fine) : exp2_at_limits(coarse, fine);
}

/// x^y from the parts of log2(x). y is split so that (high * exponent) is exact.
constexpr float pow_of_parts(Log2Parts parts, float y) {
  const float high = std::bit_cast<float>(std::bit_cast<std::uint32_t>(y) & 0xFFFFFF00U);
  return exp2_of_parts(high * parts.exponent, (y - high) * parts.exponent + y * parts.fraction);
}

constexpr float pow_of_infinity(float y) {
  if (y > 0.0F) return kInfinity;
  return y < 0.0F ? 0.0F : kNan;
}

[[gnu::noinline, gnu::cold]] constexpr float pow_outside_positive_normal(float x, float y) {
  if (y == 0.0F) return x == x ? 1.0F : kNan;
  if (x == 0.0F) return pow_of_infinity(-y);
  if (x == kInfinity) return pow_of_infinity(y);
  return x > 0.0F ? pow_of_parts(log2_parts_of_subnormal(x), y) : kNan;
}

constexpr float log_of_parts(Log2Parts parts) {
  // ln 2 in two parts: the first has 9 significant bits, its product with an exponent is exact.
  return parts.exponent * 0.693359375F + (parts.exponent * -2.12194440e-4F + parts.fraction * 0.693147181F);
}

[[gnu::noinline, gnu::cold]] constexpr float log_outside_positive_normal(float x) {
  if (x == 0.0F) return -kInfinity;
  if (x == kInfinity) return kInfinity;
  return x > 0.0F ? log_of_parts(log2_parts_of_subnormal(x)) : kNan;
}

constexpr float exp_core(float x) {
  const float shifted = x * 1.44269504F + kRoundToInteger;
  const float n = shifted - kRoundToInteger;
  const float remainder = (x - n * 0.693359375F) - n * -2.12194440e-4F;
  return scaled_exp2(shifted, remainder * 1.44269504F);
}

}  // namespace morepro::math::detail
