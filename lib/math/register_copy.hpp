#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>

/// Copies of small objects that every frame reads and writes whole: loaded() is one, store() writes it back.
/// On a Cortex-M with a floating-point unit, objects of 5 or 9 floats take one instruction, and half the
/// cycles, where the compiler (GCC 12) loads and stores each number by its own: it has no pattern for `vldm`
/// and `vstm`. This is the library's only assembly. It moves bits and computes nothing; elsewhere, and for
/// any other object, these are plain copies.
namespace morepro::math {

#if defined(__ARM_FP) && defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
/// The instructions take consecutive registers, so that the variables are bound to them.
template <class T>
T loaded(const T& from) {
  static_assert(std::is_trivially_copyable_v<T>);
  if constexpr (sizeof(T) == 5 * sizeof(float)) {
    register float a __asm("s0"), b __asm("s1"), c __asm("s2"), d __asm("s3"), e __asm("s4");
    __asm("vldmia %5, {s0-s4}" : "=t"(a), "=t"(b), "=t"(c), "=t"(d), "=t"(e) : "r"(&from), "m"(from));
    return std::bit_cast<T>(std::array{a, b, c, d, e});
  } else if constexpr (sizeof(T) == 9 * sizeof(float)) {
    register float a __asm("s0"), b __asm("s1"), c __asm("s2"), d __asm("s3"), e __asm("s4");
    register float f __asm("s5"), g __asm("s6"), h __asm("s7"), i __asm("s8");
    __asm("vldmia %9, {s0-s8}"
          : "=t"(a), "=t"(b), "=t"(c), "=t"(d), "=t"(e), "=t"(f), "=t"(g), "=t"(h), "=t"(i)
          : "r"(&from), "m"(from));
    return std::bit_cast<T>(std::array{a, b, c, d, e, f, g, h, i});
  } else {
    return from;
  }
}

template <class T>
void store(T& to, const T& from) {
  if constexpr (sizeof(T) == 5 * sizeof(float)) {
    const auto x = std::bit_cast<std::array<float, 5>>(from);
    register float a __asm("s0") = x[0], b __asm("s1") = x[1], c __asm("s2") = x[2], d __asm("s3") = x[3];
    register float e __asm("s4") = x[4];
    __asm("vstmia %1, {s0-s4}" : "=m"(to) : "r"(&to), "t"(a), "t"(b), "t"(c), "t"(d), "t"(e));
  } else if constexpr (sizeof(T) == 9 * sizeof(float)) {
    const auto x = std::bit_cast<std::array<float, 9>>(from);
    register float a __asm("s0") = x[0], b __asm("s1") = x[1], c __asm("s2") = x[2], d __asm("s3") = x[3];
    register float e __asm("s4") = x[4], f __asm("s5") = x[5], g __asm("s6") = x[6], h __asm("s7") = x[7];
    register float i __asm("s8") = x[8];
    __asm("vstmia %1, {s0-s8}"
          : "=m"(to)
          : "r"(&to), "t"(a), "t"(b), "t"(c), "t"(d), "t"(e), "t"(f), "t"(g), "t"(h), "t"(i));
  } else {
    to = from;
  }
}
#else
template <class T>
T loaded(const T& from) {
  return from;
}
template <class T>
void store(T& to, const T& from) {
  to = from;
}
#endif

}  // namespace morepro::math
