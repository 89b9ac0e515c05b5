#include "firmware/uart_link.hpp"

#include <array>
#include <cstdint>

#include "tests/support/check.hpp"

namespace morepro::firmware {
namespace {

/// A part with one byte of receive register and a sender that is always ready: the worst line there is.
struct GreedyUart {
  static inline std::uint32_t offered, taken, put_count, room;
  static inline bool receive_enabled, transmit_enabled;

  static void reset() {
    offered = taken = put_count = 0;
    room = 0xFFFFFFFFU;
    receive_enabled = true;
    transmit_enabled = false;
  }
  static bool received() { return taken < offered; }
  static std::uint8_t take() { return static_cast<std::uint8_t>(taken++); }
  static bool can_transmit() { return put_count < room; }
  static void put(std::uint8_t) { ++put_count; }
  static bool take_overrun() { return false; }
  static void receive_interrupt(bool wanted) { receive_enabled = wanted; }
  static void transmit_interrupt(bool wanted) { transmit_enabled = wanted; }
};

struct NoLock {
  NoLock() {}
};

using Link = UartLink<GreedyUart, NoLock>;

/// The interrupt comes as long as it is let in and a byte waits.
void interrupt(Link& link) {
  if (GreedyUart::receive_enabled && GreedyUart::received()) link.on_interrupt();
}

bool read(Link& link, std::uint8_t& byte) {
  if (link.received().empty()) return false;
  byte = link.received().front();
  link.drop(1);
  return true;
}

TEST(UartLink, LosesNoByteOfALineWithoutPauses) {
  GreedyUart::reset();
  static Link link;
  GreedyUart::offered = 100'000;
  std::uint8_t byte = 0;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    interrupt(link);
    ASSERT_TRUE(read(link, byte));
    ASSERT_EQ(byte, static_cast<std::uint8_t>(i));
  }
  EXPECT_FALSE(read(link, byte));
}

TEST(UartLink, MasksItsInterruptAtHighWaterAndLetsItInAgain) {
  GreedyUart::reset();
  static Link link;
  GreedyUart::offered = 100'000;
  interrupt(link);
  EXPECT_FALSE(GreedyUart::receive_enabled);
  EXPECT_EQ(GreedyUart::taken, Link::kReceiveBytes / 4 * 3);
  GreedyUart::offered = GreedyUart::taken;
  std::uint8_t byte = 0;
  while (read(link, byte)) {
  }
  EXPECT_TRUE(GreedyUart::receive_enabled);
}

TEST(UartLink, QueuesWhatThePartCannotTakeYet) {
  GreedyUart::reset();
  static Link link;
  GreedyUart::room = 3;
  const std::array<std::uint8_t, 10> message{};
  EXPECT_TRUE(link.send(message));
  EXPECT_EQ(GreedyUart::put_count, 3U);
  EXPECT_TRUE(GreedyUart::transmit_enabled);
  GreedyUart::room = 100;
  link.pump();
  EXPECT_EQ(GreedyUart::put_count, 10U);
  EXPECT_FALSE(GreedyUart::transmit_enabled);
}

TEST(UartLink, RefusesAMessageWholeWhenTheLineStands) {
  GreedyUart::reset();
  static Link link;
  GreedyUart::room = 0;
  static const std::array<std::uint8_t, Link::kTransmitBytes - 4> kLong{};
  const std::array<std::uint8_t, 5> message{};
  EXPECT_TRUE(link.send(kLong));
  EXPECT_FALSE(link.send(message));
  GreedyUart::room = 100'000;
  link.pump();
  EXPECT_EQ(GreedyUart::put_count, kLong.size());
}

}  // namespace
}  // namespace morepro::firmware
