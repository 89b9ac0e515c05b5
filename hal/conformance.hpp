#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "hal/board.hpp"

namespace morepro::hal {

/// What a board under test is known to be able to do. A capability that is false is reported as not shown; it
/// must then be refused cleanly, which is checked.
struct Capabilities {
  bool stores = true;  ///< store() keeps records (an emulator may lack the memory's controller)
  bool sends = true;   ///< send() takes messages
};

/// The checks that make a port a port. `Report` is called as report(name, passed) once per check, in a fixed
/// order, on the host from GoogleTest and on the target from the conformance image. The board is left with a
/// stored record.
template <Board B, class Report>
class Conformance {
 public:
  Conformance(B& board, Report report, Capabilities capabilities = {})
      : board_(board), report_(report), capabilities_(capabilities) {}

  void run() {
    report_("time never runs backwards", time_never_runs_backwards());
    report_("time advances", time_advances());
    report_("read_frame leaves the frame alone unless it gives one", frame_is_untouched_without_frame());
    report_("send takes messages whole", sends_short_message());
    report_("an over-long message leaves the link usable", survives_endless_message());
    report_("send takes an empty message or refuses it", survives_empty_message());
    report_("load gives back what store took", loads_what_was_stored());
    report_("a second record replaces the first", replaces_record());
    report_("store refuses an empty record", refuses_empty_record());
    report_("store refuses a record that is too large and keeps the old one", refuses_large_record());
    report_("load refuses a buffer that is too small and leaves it alone", refuses_small_buffer());
    report_("kick_watchdog returns", kicks());
    report_("reset_cause is one of the causes and does not change", reset_cause_is_stable());
    report_("enter_safe_state can be entered twice", safe_state_is_idempotent());
  }

 private:
  static constexpr std::size_t kRecordBytes = 64;
  /// Longer than any link's buffer; the bytes are never looked at when the message is refused.
  static constexpr std::size_t kEndlessBytes = 16384;
  /// A microsecond passes within this many calls on a core of up to 1 GHz.
  static constexpr int kTimeCalls = 100'000;
  using Record = std::array<std::uint8_t, kRecordBytes>;

  static Record record(std::uint8_t seed) {
    Record bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(seed + 7 * i);
    return bytes;
  }

  bool time_never_runs_backwards() {
    std::uint32_t last = board_.now_us();
    for (int i = 0; i < kTimeCalls; ++i) {
      const std::uint32_t now = board_.now_us();
      if (now - last > 0x7FFFFFFFU) return false;
      last = now;
    }
    return true;
  }

  bool time_advances() {
    const std::uint32_t start = board_.now_us();
    for (int i = 0; i < kTimeCalls; ++i)
      if (board_.now_us() != start) return true;
    return false;
  }

  bool frame_is_untouched_without_frame() {
    for (int i = 0; i < 100; ++i) {
      SensorFrame frame;
      frame.sequence = 0xDEADBEEFU;
      frame.set(Channel::kContact, 0.5F);
      if (board_.read_frame(frame) == ReadStatus::kFrame) continue;
      if (frame.sequence != 0xDEADBEEFU || frame.present != bit_of(Channel::kContact)) return false;
    }
    return true;
  }

  bool sends_short_message() {
    const Record bytes = record(1);
    return board_.send(bytes) == capabilities_.sends;
  }
  bool survives_endless_message() {
    static const std::array<std::uint8_t, kEndlessBytes> kEndless{};
    (void)board_.send(kEndless);
    const Record bytes = record(2);
    return board_.send(bytes) == capabilities_.sends;
  }
  bool survives_empty_message() {
    (void)board_.send(std::span<const std::uint8_t>{});
    return true;
  }

  bool holds(const Record& expected) {
    std::array<std::uint8_t, 2 * kRecordBytes> buffer{};
    if (!capabilities_.stores) return board_.load(buffer) == 0;
    return board_.load(buffer) == expected.size() &&
           std::memcmp(buffer.data(), expected.data(), expected.size()) == 0;
  }

  bool loads_what_was_stored() { return board_.store(record(3)) == capabilities_.stores && holds(record(3)); }
  bool replaces_record() { return board_.store(record(4)) == capabilities_.stores && holds(record(4)); }
  bool refuses_empty_record() { return !board_.store(std::span<const std::uint8_t>{}) && holds(record(4)); }
  bool refuses_large_record() {
    static const std::array<std::uint8_t, kEndlessBytes> kEndless{};
    return !board_.store(kEndless) && holds(record(4));
  }
  bool refuses_small_buffer() {
    std::array<std::uint8_t, kRecordBytes - 1> buffer{};
    buffer.fill(0x5A);
    if (board_.load(buffer) != 0) return false;
    for (const std::uint8_t byte : buffer)
      if (byte != 0x5A) return false;
    return true;
  }

  bool kicks() {
    board_.kick_watchdog();
    return true;
  }
  bool reset_cause_is_stable() {
    const ResetCause cause = board_.reset_cause();
    return cause <= ResetCause::kUnknown && board_.reset_cause() == cause;
  }
  bool safe_state_is_idempotent() {
    board_.enter_safe_state();
    board_.enter_safe_state();
    return true;
  }

  B& board_;
  Report report_;
  Capabilities capabilities_;
};

template <Board B, class Report>
void check_conformance(B& board, Report report, Capabilities capabilities = {}) {
  Conformance<B, Report>(board, report, capabilities).run();
}

}  // namespace morepro::hal
