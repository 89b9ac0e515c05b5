#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

using wire::CobsStatus;

Bytes counting(std::size_t first, std::size_t last) {
  Bytes bytes(last - first + 1);
  std::iota(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(first));
  return bytes;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const auto& part : parts) append(all, part);
  return all;
}

Bytes stuffed(const Bytes& plain) {
  Bytes out(wire::cobs_encoded_bound(plain.size()));
  out.resize(wire::cobs_encode(plain, out));
  return out;
}

Bytes random_plain(Random& random, std::size_t size) {
  Bytes plain(size);
  const auto zero_share = random() % 300;
  for (auto& byte : plain) byte = static_cast<std::uint8_t>(random() % 300 < zero_share ? 0 : random());
  return plain;
}

struct Example {
  Bytes plain;
  Bytes encoded;
};

// The examples of the paper's and of the usual description: around the longest run and around zeros.
TEST(WireCobs, EncodesTheKnownExamples) {
  const std::vector<Example> examples{
      {{0}, {1, 1}},
      {{0, 0}, {1, 1, 1}},
      {{0, 0x11, 0}, {1, 2, 0x11, 1}},
      {{0x11, 0x22, 0, 0x33}, {3, 0x11, 0x22, 2, 0x33}},
      {{0x11, 0, 0, 0}, {2, 0x11, 1, 1, 1}},
      {counting(1, 254), joined({{0xFF}, counting(1, 254)})},
      {joined({{0}, counting(1, 254)}), joined({{1, 0xFF}, counting(1, 254)})},
      {counting(1, 255), joined({{0xFF}, counting(1, 254), {2, 255}})},
      {joined({counting(2, 255), {0}}), joined({{0xFF}, counting(2, 255), {1, 1}})},
      {joined({counting(3, 255), {0, 1}}), joined({{0xFE}, counting(3, 255), {2, 1}})},
  };
  for (const auto& example : examples) EXPECT_EQ(stuffed(example.plain), example.encoded);
}

TEST(WireCobs, GivesBackWhatWasEncodedWithoutAnyZeroBetween) {
  Random random(2);
  for (std::size_t size = 0; size < 1100; ++size) {
    const Bytes plain = random_plain(random, size);
    const Bytes encoded = stuffed(plain);
    EXPECT_EQ(std::count(encoded.begin(), encoded.end(), 0), 0);
    Bytes decoded(size);
    const auto result = wire::cobs_decode(encoded, decoded);
    EXPECT_EQ(result.status, CobsStatus::kOk);
    EXPECT_EQ(result.size, size);
    EXPECT_EQ(decoded, plain);
  }
}

TEST(WireCobs, EncodesIntoExactlyEnoughAndNeverBeyond) {
  Random random(3);
  for (const std::size_t size : {1U, 70U, 254U, 255U, 508U, 600U}) {
    const Bytes plain = random_plain(random, size);
    const Bytes encoded = stuffed(plain);
    for (std::size_t room = 0; room < encoded.size(); ++room) {
      Bytes out(encoded.size() + 1, 0xA5);
      EXPECT_EQ(wire::cobs_encode(plain, std::span(out).first(room)), 0U);
      EXPECT_EQ(out[room], 0xA5);
    }
    Bytes out(encoded.size());
    EXPECT_EQ(wire::cobs_encode(plain, out), encoded.size());
  }
}

TEST(WireCobs, DecodesIntoExactlyEnoughAndNeverBeyond) {
  Random random(4);
  for (const std::size_t size : {1U, 15U, 16U, 17U, 70U, 254U, 600U}) {
    const Bytes plain = random_plain(random, size);
    const Bytes encoded = stuffed(plain);
    for (std::size_t room = 0; room < size; ++room) {
      Bytes out(size + 1, 0xA5);
      EXPECT_EQ(wire::cobs_decode(encoded, std::span(out).first(room)).status, CobsStatus::kTooLong);
      EXPECT_EQ(out[room], 0xA5);
    }
  }
}

TEST(WireCobs, RefusesARunThatIsCut) {
  const Bytes encoded{4, 1, 2};
  Bytes out(64);
  EXPECT_EQ(wire::cobs_decode(encoded, out).status, CobsStatus::kBroken);
  EXPECT_EQ(wire::cobs_decode(Bytes{2, 9, 0, 1}, out).status, CobsStatus::kBroken) << "0x00 is no code";
}

TEST(WireCobs, ByteByByteGivesTheSameAsTheWhole) {
  Random random(5);
  wire::CobsStream<64> stream;
  for (int round = 0; round < 20000; ++round) {
    Bytes encoded(1 + random() % 90);
    for (auto& byte : encoded) byte = static_cast<std::uint8_t>(1 + random() % (round % 2 == 0 ? 255 : 6));
    Bytes whole(64);
    const auto expected = wire::cobs_decode(encoded, whole);
    for (const std::uint8_t byte : encoded) stream.push(byte);
    const auto result = stream.finish();
    ASSERT_EQ(result.status, expected.status);
    if (result.status != CobsStatus::kOk) continue;
    ASSERT_EQ(result.size, expected.size);
    ASSERT_TRUE(std::ranges::equal(stream.decoded(result.size), std::span(whole).first(result.size)));
  }
}

TEST(WireCobs, ByteByByteGivesBackLongRuns) {
  Random random(16);
  wire::CobsStream<1100> stream;
  for (std::size_t size = 0; size < 1100; ++size) {
    const Bytes plain = random_plain(random, size);
    for (const std::uint8_t byte : stuffed(plain)) stream.push(byte);
    const auto result = stream.finish();
    ASSERT_EQ(result.status, CobsStatus::kOk);
    ASSERT_TRUE(std::ranges::equal(stream.decoded(result.size), plain)) << size;
  }
}

}  // namespace
}  // namespace morepro::wire_test
