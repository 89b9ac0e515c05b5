#include "firmware/boards/mps2/preserved_store.hpp"

namespace morepro::firmware::mps2 {
namespace {

constexpr std::uint32_t kErased = 0xFFFFFFFFU;
/// Two words that RAM does not hold by chance after power-on.
constexpr std::uint32_t kRunning = 0x52554E21U;
constexpr std::uint32_t kWatchdogExpired = 0x57444F47U;

__attribute__((section(".preserve.slots"))) volatile std::uint32_t slots[2][PreservedStore::kSlotBytes / 4];
__attribute__((section(".preserve.mark"))) volatile std::uint32_t mark;

}  // namespace

bool PreservedStore::erase(std::uint32_t slot) {
  for (volatile std::uint32_t& word : slots[slot]) word = kErased;
  return true;
}

bool PreservedStore::write_word(std::uint32_t slot, std::uint32_t offset, std::uint32_t word) {
  slots[slot][offset / 4] = word;
  return true;
}

std::uint32_t PreservedStore::read_word(std::uint32_t slot, std::uint32_t offset) const {
  return slots[slot][offset / 4];
}

void mark_watchdog_reset() { mark = kWatchdogExpired; }

hal::ResetCause take_reset_cause() {
  const std::uint32_t found = mark;
  mark = kRunning;
  if (found == kWatchdogExpired) return hal::ResetCause::kWatchdog;
  return found == kRunning ? hal::ResetCause::kSoftware : hal::ResetCause::kPowerOn;
}

}  // namespace morepro::firmware::mps2
