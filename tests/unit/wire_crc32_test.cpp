#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// Values of zlib's crc32(); the first is the check value that every catalogue of CRCs lists for CRC-32.
TEST(WireCrc32, AgreesWithZlib) {
  EXPECT_EQ(wire::crc32(bytes_of("123456789")), 0xCBF43926U);
  EXPECT_EQ(wire::crc32(bytes_of("")), 0U);
  EXPECT_EQ(wire::crc32(bytes_of("a")), 0xE8B7BE43U);
  EXPECT_EQ(wire::crc32(bytes_of("The quick brown fox jumps over the lazy dog")), 0x414FA339U);
}

TEST(WireCrc32, IsTheSameWithEveryTableSize) {
  Random random(1);
  Bytes bytes(300);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const auto part = std::span(bytes).last(size);
    EXPECT_EQ(wire::crc32<1>(part), wire::crc32<8>(part)) << size << " bytes";
  }
}

TEST(WireByteOrder, IsLeastSignificantByteFirst) {
  std::array<std::uint8_t, 8> bytes{};
  wire::store_little_endian(bytes.data(), std::uint64_t{0x0102030405060708U});
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 8>{8, 7, 6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(wire::load_little_endian<std::uint32_t>(bytes.data()), 0x05060708U);
  EXPECT_EQ(wire::load_little_endian<std::uint16_t>(bytes.data() + 1), 0x0607U);
}

TEST(WireByteOrder, KnowsOneNan) {
  for (const std::uint32_t nan : {0x7f800001U, 0x7fc00000U, 0xffc00000U, 0xffffffffU})
    EXPECT_EQ(wire::canonical_bits(std::bit_cast<float>(nan)), 0x7fc00000U);
  for (const std::uint64_t nan : {0x7ff0000000000001ULL, 0xfff8000000000000ULL})
    EXPECT_EQ(wire::canonical_bits(std::bit_cast<double>(nan)), 0x7ff8000000000000ULL);
  EXPECT_EQ(wire::canonical_bits(-std::numeric_limits<float>::infinity()), 0xff800000U);
  EXPECT_EQ(wire::canonical_bits(-0.0F), 0x80000000U);
}

TEST(WireByteStream, StopsAtTheEndAndStaysStopped) {
  std::array<std::uint8_t, 3> bytes{};
  wire::ByteWriter writer(bytes);
  writer.put(std::uint16_t{0x0201});
  writer.put(std::uint32_t{0});
  writer.put(std::uint8_t{3});
  EXPECT_FALSE(writer.ok());
  EXPECT_EQ(writer.written().size(), 2U);

  wire::ByteReader reader(bytes);
  EXPECT_EQ(reader.get<std::uint32_t>(), 0U);
  EXPECT_EQ(reader.get<std::uint8_t>(), 0U);
  EXPECT_FALSE(reader.is_complete());
}

}  // namespace
}  // namespace morepro::wire_test
