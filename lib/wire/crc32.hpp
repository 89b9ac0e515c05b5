#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "lib/wire/byte_order.hpp"

namespace morepro::wire {

/// Polynomial of IEEE 802.3, reflected: the CRC-32 of zlib, Ethernet and PNG.
inline constexpr std::uint32_t kCrc32Polynomial = 0xEDB88320U;

template <std::size_t kSlices>
using Crc32Tables = std::array<std::array<std::uint32_t, 256>, kSlices>;

/// Table k holds the effect of one byte that k more bytes follow.
template <std::size_t kSlices>
constexpr Crc32Tables<kSlices> make_crc32_tables() {
  Crc32Tables<kSlices> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? kCrc32Polynomial : 0U);
    tables[0][byte] = crc;
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t previous = tables[slice - 1][byte];
      tables[slice][byte] = (previous >> 8) ^ tables[0][previous & 0xFFU];
    }
  return tables;
}

template <std::size_t kSlices>
inline constexpr Crc32Tables<kSlices> kCrc32Tables = make_crc32_tables<kSlices>();

/// Bytes per step. A PC takes eight at once (8 KiB of tables); a 32-bit board one (1 KiB of flash).
inline constexpr std::size_t kCrc32Slices = sizeof(void*) >= 8 ? 8 : 1;

template <std::size_t kSlices, std::size_t... kIndex>
std::uint32_t crc32_step(std::uint64_t eight_bytes, std::index_sequence<kIndex...>) {
  return (kCrc32Tables<kSlices>[7 - kIndex][(eight_bytes >> (8 * kIndex)) & 0xFFU] ^ ...);
}

/// CRC-32 of `bytes`, equal to zlib's crc32(0, ...). kSlices: 1 or 8, the same result.
template <std::size_t kSlices = kCrc32Slices>
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  static_assert(kSlices == 1 || kSlices == 8);
  std::uint32_t crc = 0xFFFFFFFFU;
  if constexpr (kSlices == 8)
    for (; bytes.size() >= 8; bytes = bytes.subspan(8))
      crc =
          crc32_step<8>(load_little_endian<std::uint64_t>(bytes.data()) ^ crc, std::make_index_sequence<8>{});
  for (const std::uint8_t byte : bytes) crc = (crc >> 8) ^ kCrc32Tables<kSlices>[0][(crc ^ byte) & 0xFFU];
  return ~crc;
}

}  // namespace morepro::wire
