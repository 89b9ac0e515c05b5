#pragma once
#include <bit>
#include <cstdint>

namespace morepro::test {

/// FNV-1a over the bits of floats; every NaN counts as one, because its payload is the processor's choice.
class BitHash {
 public:
  void add(float x) { add_word(x == x ? std::bit_cast<std::uint32_t>(x) : 0x7FC00000U); }
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    add_word(static_cast<std::uint32_t>(bits));
    add_word(static_cast<std::uint32_t>(bits >> 32));
  }
  [[nodiscard]] std::uint32_t value() const { return value_; }

 private:
  void add_word(std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) value_ = (value_ ^ ((word >> shift) & 0xFFU)) * 16777619U;
  }
  std::uint32_t value_ = 2166136261U;
};

}  // namespace morepro::test
