#pragma once
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace morepro::wire {

/// The unsigned integer with the bytes of `value` in reverse order.
template <std::unsigned_integral U>
constexpr U reversed_bytes(U value) {
  if constexpr (sizeof(U) == 8) return __builtin_bswap64(value);
  if constexpr (sizeof(U) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(U) == 2) return __builtin_bswap16(value);
  return value;
}

template <std::unsigned_integral U>
constexpr U little_endian(U value) {
  return std::endian::native == std::endian::little ? value : reversed_bytes(value);
}

/// Reads sizeof(U) bytes, least significant first, from any alignment.
template <std::unsigned_integral U>
U load_little_endian(const std::uint8_t* bytes) {
  U value;
  std::memcpy(&value, bytes, sizeof(U));
  return little_endian(value);
}

/// Writes sizeof(U) bytes, least significant first, to any alignment.
template <std::unsigned_integral U>
void store_little_endian(std::uint8_t* bytes, U value) {
  const U ordered = little_endian(value);
  std::memcpy(bytes, &ordered, sizeof(U));
}

/// The unsigned integer as wide as T.
template <class T>
using BitsOf =
    std::conditional_t<sizeof(T) == 8, std::uint64_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                          std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

/// IEEE 754 bits; every NaN becomes the same one (0x7fc00000 for float), so that equal results are equal
/// bytes.
template <std::floating_point F>
constexpr BitsOf<F> canonical_bits(F value) {
  static_assert(std::numeric_limits<F>::is_iec559);
  constexpr auto kInfinity = std::bit_cast<BitsOf<F>>(std::numeric_limits<F>::infinity());
  constexpr auto kQuietNan = kInfinity | (BitsOf<F>{1} << (std::numeric_limits<F>::digits - 2));
  const auto bits = std::bit_cast<BitsOf<F>>(value);
  const auto magnitude = bits & (~BitsOf<F>{0} >> 1);
  return magnitude > kInfinity ? kQuietNan : bits;
}

}  // namespace morepro::wire
