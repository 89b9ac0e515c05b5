#pragma once
#include <cstdint>

#include "hal/board.hpp"

namespace morepro::firmware::mps2 {

/// RAM that no start-up code clears: it keeps its content over a reset, not over a power cut. It stands in
/// for the flash that this board does not have, word by word as flash is written.
class PreservedStore {
 public:
  static constexpr std::uint32_t kSlotBytes = 1088;

  [[nodiscard]] static constexpr std::uint32_t slot_bytes() { return kSlotBytes; }
  bool erase(std::uint32_t slot);
  bool write_word(std::uint32_t slot, std::uint32_t offset, std::uint32_t word);
  [[nodiscard]] std::uint32_t read_word(std::uint32_t slot, std::uint32_t offset) const;
};

/// The part has no register that tells why it started: the handler of the watchdog's first expiry leaves a
/// mark.
void mark_watchdog_reset();
/// Reads the mark and sets it anew, so that the next start is told apart too.
hal::ResetCause take_reset_cause();

}  // namespace morepro::firmware::mps2
