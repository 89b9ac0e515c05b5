#pragma once
#include <cstdint>

#include "firmware/boards/almec/almec_board_pins.hpp"
#include "firmware/boards/almec/f405_registers.hpp"
#include "firmware/boards/cortex_m/mmio.hpp"

namespace morepro::firmware::f405 {

/// Baud divider with eightfold oversampling: 4 fraction bits of which the lowest is left out.
constexpr std::uint32_t baud_divider(std::uint32_t clock_hz, std::uint32_t baud) {
  const std::uint32_t eighths = (clock_hz + baud / 2) / baud;
  return ((eighths / 8) << 4) | (eighths % 8);
}

/// USART1 for UartLink.
template <class Bus>
struct Usart1 {
  /// Pins, clock, baud rate; whatever was received before this is lost: the peer waits for the READY message.
  static void start(std::uint32_t clock_hz, std::uint32_t baud) {
    set_bits<Bus>(rcc::kAhb1Enr, rcc::kGpioAEnable);
    set_bits<Bus>(rcc::kApb2Enr, rcc::kUsart1Enable);
    for (const std::uint32_t pin : {almec::kLinkTransmitPin, almec::kLinkReceivePin,
                                    almec::kLinkClearToSendPin, almec::kLinkRequestToSendPin})
      connect(pin);
    Bus::write(usart1::kBrr, baud_divider(clock_hz, baud));
    Bus::write(usart1::kCr3, usart1::kRequestToSend | usart1::kClearToSend);
    Bus::write(usart1::kCr1, usart1::kUsartEnable | usart1::kOversampleBy8 | usart1::kTransmitEnable |
                                 usart1::kReceiveEnable | usart1::kReceiveInterrupt);
  }

  static bool received() { return (Bus::read(usart1::kSr) & usart1::kReceived) != 0; }
  static std::uint8_t take() { return static_cast<std::uint8_t>(Bus::read(usart1::kDr)); }
  static bool can_transmit() { return (Bus::read(usart1::kSr) & usart1::kTransmitEmpty) != 0; }
  static void put(std::uint8_t byte) { Bus::write(usart1::kDr, byte); }
  /// The flag goes with the next read of the data register, which receive() does at once.
  static bool take_overrun() { return (Bus::read(usart1::kSr) & usart1::kOverrun) != 0; }

  static void receive_interrupt(bool wanted) {
    change_bits<Bus>(usart1::kCr1, usart1::kReceiveInterrupt, wanted ? usart1::kReceiveInterrupt : 0);
  }
  static void transmit_interrupt(bool wanted) {
    change_bits<Bus>(usart1::kCr1, usart1::kTransmitInterrupt, wanted ? usart1::kTransmitInterrupt : 0);
  }

 private:
  static void connect(std::uint32_t pin) {
    change_bits<Bus>(gpio::kA + gpio::kMode, 3U << (2 * pin), 2U << (2 * pin));
    change_bits<Bus>(gpio::kA + gpio::kSpeed, 3U << (2 * pin), 2U << (2 * pin));
    change_bits<Bus>(gpio::kA + gpio::kAlternateHigh, 15U << (4 * (pin - 8)), 7U << (4 * (pin - 8)));
  }
};

}  // namespace morepro::firmware::f405
