#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "lib/math/float_parts.hpp"

/// Building blocks of the trigonometric functions of elementary.hpp: an angle as a quarter turn and a
/// remainder, and polynomials on that remainder.
namespace morepro::math::detail {

/// x = quarter * pi/2 + remainder, remainder in [-0.7875, 0.7875]; of the quarter only the two lowest bits
/// count.
struct QuarterTurn {
  std::uint32_t quarter;
  float remainder;
};

/// Up to here the number of quarter turns has 16 bits, and its product with 8 bits of pi/2 is exact.
inline constexpr float kLargestNearAngle = 1.0e5F;

/// |x| <= kLargestNearAngle. pi/2 is taken off in three exact pieces and a rest; what is left out is 5e-17 of
/// a quarter turn.
constexpr QuarterTurn near_quarter_turn(float x) {
  const float shifted = x * 0.636619747F + kRoundToInteger;
  const float n = shifted - kRoundToInteger;
  float remainder = x - n * 0x1.92p+0F;
  remainder -= n * 0x1.FAp-12F;
  remainder -= n * 0x1.54p-20F;
  remainder -= n * 0x1.10B462p-30F;
  return {std::bit_cast<std::uint32_t>(shifted), remainder};
}

/// 2/pi in words of 32 bits, behind one word of zeros.
inline constexpr std::array<std::uint32_t, 8> kTwoOverPi{0x00000000U, 0xA2F9836EU, 0x4E441529U, 0xFC2757D1U,
                                                         0xF534DDC0U, 0xDB629599U, 0x3C439041U, 0xFE5163ABU};

constexpr std::uint64_t two_over_pi_word(std::uint32_t first_bit) {
  const std::uint32_t word = first_bit >> 5;
  const std::uint64_t pair = (std::uint64_t{kTwoOverPi[word]} << 32) | kTwoOverPi[word + 1];
  return ((pair << (first_bit & 31U)) >> 32) & 0xFFFFFFFFU;
}

/// |x| > kLargestNearAngle, finite. x is an integer times a power of two: of its product with 2/pi, whole
/// turns are left out before they are computed, 64 bits of the fraction of a turn are kept.
[[gnu::noinline, gnu::cold]] constexpr QuarterTurn far_quarter_turn(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t first_bit = ((bits >> 23) & 0xFFU) - 120U;
  const std::uint64_t mantissa = (bits & 0x007FFFFFU) | 0x00800000U;
  const std::uint64_t turn = ((mantissa * two_over_pi_word(first_bit)) << 32) +
                             mantissa * two_over_pi_word(first_bit + 32) +
                             ((mantissa * two_over_pi_word(first_bit + 64)) >> 32);
  const auto quarter = static_cast<std::uint32_t>((turn + (1ULL << 61)) >> 62);
  const auto rest = static_cast<std::int64_t>(turn - (std::uint64_t{quarter} << 62));
  const float remainder = static_cast<float>(rest) * (1.57079633F * 0x1.0p-62F);
  return x < 0.0F ? QuarterTurn{0U - quarter, -remainder} : QuarterTurn{quarter, remainder};
}

constexpr QuarterTurn quarter_turn(float x) {
  if (magnitude(x) <= kLargestNearAngle) return near_quarter_turn(x);
  return x - x == 0.0F ? far_quarter_turn(x) : QuarterTurn{0, kNan};
}

/// |x| <= 0.7875. Approximation error below 4e-9.
constexpr float sin_core(float x) {
  const float z = x * x;
  return x + x * z * (-0.166666538F + z * (0.00833214819F + z * -0.000195135392F));
}

/// |x| <= 0.7875. Approximation error below 2e-10.
constexpr float cos_core(float x) {
  const float z = x * x;
  return 1.0F + z * (-0.5F + z * (0.0416666456F + z * (-0.0013887299F + z * 2.4431165e-5F)));
}

/// Arc tangent of |x| <= 0.4143. Approximation error below 2.1e-8.
constexpr float atan_core(float x) {
  const float z = x * x;
  return x + x * z * (-0.333329499F + z * (0.199776843F + z * (-0.138773844F + z * 0.0805270374F)));
}

/// Angle of the direction (x, y) in the first octant: 0 <= y <= x, x > 0.
constexpr float atan_of_octant(float y, float x) {
  if (y <= 0.41421356F * x) return atan_core(y / x);
  return 0.785398163F + atan_core((y - x) / (y + x));
}

constexpr float with_sign(float x, bool is_negative) { return is_negative ? -x : x; }

}  // namespace morepro::math::detail
