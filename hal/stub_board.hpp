#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/board.hpp"

namespace morepro::hal {

/// A board that has nothing: no clock, no sensors, no link, no memory. Copy it to firmware/boards/<name>/,
/// rename it, and replace one operation after the other; until then each gives the answer that can harm
/// nobody.
class StubBoard {
 public:
  /// A counter that runs by itself: 32 bits, microseconds.
  std::uint32_t now_us() { return ++calls_; }

  /// What the receive interrupt has collected, decoded; see FrameLink for frames that come over a line.
  ReadStatus read_frame(SensorFrame&) { return ReadStatus::kNothing; }

  /// Into a transmit buffer, never waiting for the line.
  bool send(std::span<const std::uint8_t>) { return false; }

  /// See two_slot_store.hpp for flash or RAM that survives.
  std::size_t load(std::span<std::uint8_t>) { return 0; }
  bool store(std::span<const std::uint8_t>) { return false; }

  void kick_watchdog() {}

  /// Outputs off, stop requested.
  void enter_safe_state() {}

  ResetCause reset_cause() { return ResetCause::kUnknown; }

 private:
  std::uint32_t calls_ = 0;
};

static_assert(Board<StubBoard>);

}  // namespace morepro::hal
