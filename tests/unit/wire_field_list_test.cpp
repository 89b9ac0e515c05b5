#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <tuple>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

struct Inner {
  double real = 0.0;
  bool flag = false;
};

struct Outer {
  std::uint16_t number = 0;
  std::array<Inner, 2> inner{};
  std::array<float, 3> values{};
};

}  // namespace
}  // namespace morepro::wire_test

namespace morepro::wire {

template <>
inline constexpr auto kFields<wire_test::Inner> =
    std::tuple{&wire_test::Inner::real, &wire_test::Inner::flag};
template <>
inline constexpr auto kFields<wire_test::Outer> =
    std::tuple{&wire_test::Outer::number, &wire_test::Outer::inner, &wire_test::Outer::values};

}  // namespace morepro::wire

namespace morepro::wire_test {
namespace {

TEST(WireFieldList, CountsTheFieldsOfAStructAndItsBytesWithoutPadding) {
  EXPECT_EQ(wire::field_count<Inner>(), 2U);
  EXPECT_EQ(wire::field_count<Outer>(), 3U);
  EXPECT_EQ(wire::wire_size<Outer>(), 2U + 2U * (8U + 1U) + 3U * 4U);
}

TEST(WireFieldList, NoticesAFieldThatTheListForgot) {
  struct Grown {
    int listed = 0;
    int forgotten = 0;
  };
  EXPECT_FALSE(wire::is_whole<Grown>()) << "an empty list for two fields";
  EXPECT_TRUE(wire::is_whole<Outer>());
}

TEST(WireFieldList, GivesBackWhatWasWritten) {
  const Outer outer{.number = 0x1234, .inner = {{{1.5, true}, {-2.5, false}}}, .values = {1.0F, 2.0F, 3.0F}};
  Bytes bytes(wire::wire_size<Outer>());
  wire::ByteWriter writer(bytes);
  wire::write_fields(writer, outer);
  ASSERT_TRUE(writer.ok());
  wire::ByteReader reader(bytes);
  Outer back;
  wire::read_fields(reader, back);
  EXPECT_TRUE(reader.is_complete());
  EXPECT_FALSE(reader.is_rejected());
  EXPECT_EQ(back.number, outer.number);
  EXPECT_EQ(back.inner[0].real, 1.5);
  EXPECT_TRUE(back.inner[0].flag);
  EXPECT_FALSE(back.inner[1].flag);
  EXPECT_EQ(back.values, outer.values);
}

TEST(WireFieldList, RejectsATruthValueOtherThanZeroAndOne) {
  Bytes bytes(wire::wire_size<Inner>());
  bytes.back() = 2;
  wire::ByteReader reader(bytes);
  Inner back;
  wire::read_fields(reader, back);
  EXPECT_TRUE(reader.is_rejected());
}

TEST(WireFieldList, ReadsAndWritesNothingWhereOneByteIsMissing) {
  Bytes bytes(wire::wire_size<Inner>() - 1);
  wire::ByteWriter writer(bytes);
  wire::write_fields(writer, Inner{.real = 1.0});
  EXPECT_FALSE(writer.ok());
  EXPECT_TRUE(writer.written().empty());
  wire::ByteReader reader(bytes);
  Inner back{.real = 7.0};
  wire::read_fields(reader, back);
  EXPECT_FALSE(reader.is_complete());
  EXPECT_EQ(back.real, 7.0);
}

}  // namespace
}  // namespace morepro::wire_test
