#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/board.hpp"
#include "lib/wire/record_codec.hpp"

namespace morepro::firmware {

/// A real board whose line has a test harness at its other end, which sends a configuration, frames and End.
/// Differs from the product in three things: it takes the configuration from the line, it believes End, and
/// it waits for the line where the product would drop a message.
template <hal::Board B>
class LineTestBoard {
 public:
  explicit LineTestBoard(B& board) : board_(board) {}

  std::uint32_t now_us() { return board_.now_us(); }
  hal::ReadStatus read_frame(SensorFrame& frame) { return board_.read_line(frame); }

  bool send(std::span<const std::uint8_t> message) {
    for (std::uint32_t poll = 0; poll < kPolls; ++poll) {
      if (board_.send(message)) return true;
      board_.kick_watchdog();
    }
    return false;
  }

  /// Says Ready first: bytes that come earlier are lost in the part, so that the harness waits for it.
  std::size_t load(std::span<std::uint8_t> buffer) {
    const wire::Ready ready{.reset_cause = static_cast<std::uint8_t>(board_.reset_cause())};
    const std::size_t size = wire::encode(ready, buffer);
    (void)send(buffer.first(size));
    return board_.frames().read_configuration(buffer, kPolls, [this] { board_.kick_watchdog(); });
  }

  bool store(std::span<const std::uint8_t> record) { return board_.store(record); }
  void kick_watchdog() { board_.kick_watchdog(); }
  void enter_safe_state() { board_.enter_safe_state(); }
  hal::ResetCause reset_cause() { return board_.reset_cause(); }

 private:
  /// Some seconds, whatever the clock.
  static constexpr std::uint32_t kPolls = 100'000'000;

  B& board_;
};

}  // namespace morepro::firmware
