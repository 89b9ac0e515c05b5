#pragma once
#include <cstdint>
#include <span>

#include "firmware/byte_ring.hpp"

namespace morepro::firmware {

/// A serial line with a receive ring and a transmit ring; `Uart` is the register driver of one part:
/// static bool received(), std::uint8_t take(), bool can_transmit(), void put(byte), void
/// receive_interrupt(bool), void transmit_interrupt(bool), bool take_overrun(); `Lock` masks interrupts while
/// it lives. At the high-water mark the receive interrupt is masked: the byte stays in the part, which holds
/// the sender by its request-to-send line. Without that a virtual line, which knows no baud rate, overflows
/// any ring.
template <class Uart, class Lock>
class UartLink {
 public:
  static constexpr std::size_t kReceiveBytes = 4096;
  static constexpr std::size_t kTransmitBytes = 2048;

  /// From the interrupt handler.
  void on_interrupt() {
    if (Uart::take_overrun()) overruns_ = overruns_ + 1;
    receive();
    if (!to_send_.empty()) transmit();
  }

  /// Received bytes that lie side by side; empty: none.
  [[nodiscard]] std::span<const std::uint8_t> received() const { return received_.front(); }

  /// `count` bytes of received() are done with.
  void drop(std::size_t count) {
    received_.drop(count);
    if (holding_ && received_.below_low_water()) release();
  }

  [[nodiscard]] bool has_received() const { return !received_.empty(); }

  /// Queues a whole message or refuses it.
  bool send(std::span<const std::uint8_t> message) {
    const Lock lock;
    transmit();
    const bool taken = to_send_.push_all(message);
    transmit();
    return taken;
  }

  /// Moves what waits to the part; called by the loop too, because not every part interrupts on an empty
  /// transmitter.
  void pump() {
    const Lock lock;
    transmit();
  }

  [[nodiscard]] bool all_sent() const { return to_send_.empty(); }
  /// Bytes that the part itself lost, at least.
  [[nodiscard]] std::uint32_t overruns() const { return overruns_; }

 private:
  void receive() {
    while (Uart::received()) {
      if (received_.above_high_water()) return hold();
      received_.push(Uart::take());
    }
  }

  void hold() {
    holding_ = true;
    Uart::receive_interrupt(false);
  }

  void release() {
    const Lock lock;
    holding_ = false;
    receive();
    if (!holding_) Uart::receive_interrupt(true);
  }

  void transmit() {
    std::uint8_t byte = 0;
    while (Uart::can_transmit() && to_send_.pop(byte)) Uart::put(byte);
    Uart::transmit_interrupt(!to_send_.empty());
  }

  ByteRing<kReceiveBytes> received_;
  ByteRing<kTransmitBytes> to_send_;
  volatile bool holding_ = false;
  volatile std::uint32_t overruns_ = 0;
};

}  // namespace morepro::firmware
