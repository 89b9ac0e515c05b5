#include <cstdint>

#include "firmware/uart_link.hpp"
#include "tests/target/count/count.hpp"

namespace morepro {
namespace {

/// A part that has one byte for every interrupt; its registers are ordinary words, its accesses as many as
/// real ones.
struct MemoryUart {
  static inline volatile std::uint32_t status, data, control;

  static bool received() { return (status & 1U) != 0; }
  static std::uint8_t take() {
    status = 0;
    return static_cast<std::uint8_t>(data);
  }
  static bool can_transmit() { return true; }
  static void put(std::uint8_t byte) { data = byte; }
  static bool take_overrun() { return (status & 8U) != 0; }
  static void receive_interrupt(bool wanted) { control = control | (wanted ? 32U : 0U); }
  static void transmit_interrupt(bool wanted) { control = (control & ~128U) | (wanted ? 128U : 0U); }
};

struct NoLock {
  NoLock() {}
};

using Link = firmware::UartLink<MemoryUart, NoLock>;

Link& link() {
  static Link the_link;
  return the_link;
}

void byte_arrives() { MemoryUart::status = 1; }

void receive_byte() {
  link().on_interrupt();
  link().drop(1);
}

const count::Entry kReceiveByte("receive_byte", 1, byte_arrives, receive_byte);

}  // namespace
}  // namespace morepro
