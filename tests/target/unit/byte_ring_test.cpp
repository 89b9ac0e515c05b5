#include "firmware/byte_ring.hpp"

#include <array>

#include "tests/support/check.hpp"

namespace morepro::firmware {
namespace {

using Ring = ByteRing<16>;

void fill(Ring& ring, int count) {
  for (int i = 0; i < count; ++i) ring.push(static_cast<std::uint8_t>(i));
}

TEST(ByteRing, GivesBytesInOrderAcrossItsEnd) {
  Ring ring;
  std::uint8_t byte = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(ring.push(static_cast<std::uint8_t>(i)));
    EXPECT_TRUE(ring.push(static_cast<std::uint8_t>(i + 1)));
    EXPECT_TRUE(ring.pop(byte));
    EXPECT_EQ(byte, static_cast<std::uint8_t>(i));
    EXPECT_TRUE(ring.pop(byte));
    EXPECT_EQ(byte, static_cast<std::uint8_t>(i + 1));
  }
  EXPECT_FALSE(ring.pop(byte));
}

TEST(ByteRing, ShowsWhatLiesSideBySideUpToItsEnd) {
  Ring ring;
  fill(ring, 12);
  ring.drop(10);
  fill(ring, 8);
  EXPECT_EQ(ring.front().size(), 6U);
  EXPECT_EQ(ring.front()[0], 10);
  ring.drop(6);
  EXPECT_EQ(ring.front().size(), 4U);
  EXPECT_EQ(ring.front()[0], 4);
}

TEST(ByteRing, RefusesWhatDoesNotFitAndKeepsWhatItHas) {
  Ring ring;
  fill(ring, 16);
  EXPECT_FALSE(ring.push(99));
  std::uint8_t byte = 0;
  EXPECT_TRUE(ring.pop(byte));
  EXPECT_EQ(byte, 0);
  EXPECT_TRUE(ring.push(16));
  EXPECT_EQ(ring.size(), 16U);
}

TEST(ByteRing, TakesAMessageWholeOrNotAtAll) {
  Ring ring;
  fill(ring, 10);
  const std::array<std::uint8_t, 7> message{};
  EXPECT_FALSE(ring.push_all(message));
  EXPECT_EQ(ring.size(), 10U);
  EXPECT_TRUE(ring.push_all(std::span(message).first(6)));
  EXPECT_EQ(ring.size(), 16U);
}

TEST(ByteRing, HoldsTheSenderAboveThreeQuartersAndReleasesItBelowOne) {
  Ring ring;
  fill(ring, 11);
  EXPECT_FALSE(ring.above_high_water());
  fill(ring, 1);
  EXPECT_TRUE(ring.above_high_water());
  std::uint8_t byte = 0;
  for (int i = 0; i < 7; ++i) ring.pop(byte);
  EXPECT_FALSE(ring.below_low_water());
  ring.pop(byte);
  EXPECT_TRUE(ring.below_low_water());
}

}  // namespace
}  // namespace morepro::firmware
