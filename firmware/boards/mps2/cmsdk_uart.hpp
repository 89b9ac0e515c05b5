#pragma once
#include <cstdint>

#include "firmware/boards/cortex_m/mmio.hpp"
#include "firmware/boards/mps2/mps2_registers.hpp"

namespace morepro::firmware::mps2 {

/// UART0 for UartLink.
template <class Bus>
struct Uart0 {
  static void start() {
    Bus::write(uart0::kBaudDivider, uart0::kFastest);
    Bus::write(uart0::kControl, uart0::kTransmitEnable | uart0::kReceiveEnable | uart0::kReceiveInterrupt);
  }

  static bool received() { return (Bus::read(uart0::kState) & uart0::kReceiveFull) != 0; }
  /// The interrupt is acknowledged before the data register is read: a byte that follows raises it again.
  static std::uint8_t take() {
    Bus::write(uart0::kInterruptClear, uart0::kReceiveInterruptBit);
    return static_cast<std::uint8_t>(Bus::read(uart0::kData));
  }
  static bool can_transmit() { return (Bus::read(uart0::kState) & uart0::kTransmitFull) == 0; }
  static void put(std::uint8_t byte) {
    Bus::write(uart0::kInterruptClear, uart0::kTransmitInterruptBit);
    Bus::write(uart0::kData, byte);
  }

  static bool take_overrun() {
    if ((Bus::read(uart0::kState) & uart0::kReceiveOverrun) == 0) return false;
    Bus::write(uart0::kState, uart0::kReceiveOverrun);
    return true;
  }

  static void receive_interrupt(bool wanted) {
    change_bits<Bus>(uart0::kControl, uart0::kReceiveInterrupt, wanted ? uart0::kReceiveInterrupt : 0);
  }
  static void transmit_interrupt(bool wanted) {
    change_bits<Bus>(uart0::kControl, uart0::kTransmitInterrupt, wanted ? uart0::kTransmitInterrupt : 0);
    if (!wanted) Bus::write(uart0::kInterruptClear, uart0::kTransmitInterruptBit);
  }
};

}  // namespace morepro::firmware::mps2
