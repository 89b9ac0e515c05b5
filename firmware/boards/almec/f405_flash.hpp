#pragma once
#include <cstdint>

#include "firmware/boards/almec/f405_registers.hpp"
#include "firmware/boards/cortex_m/mmio.hpp"

namespace morepro::firmware::f405 {

/// The last two sectors (128 KiB each) as the two slots of hal::TwoSlotStore; the linker file keeps code out
/// of them. The part stalls while it erases (typically 1 s, at most 2 s) because it also executes from flash:
/// call it idle.
template <class Bus>
class StoreFlash {
 public:
  static constexpr std::uint32_t kSlotBytes = 4096;

  [[nodiscard]] static constexpr std::uint32_t slot_bytes() { return kSlotBytes; }

  bool erase(std::uint32_t slot) {
    if (!unlock()) return false;
    Bus::write(flash::kCr,
               flash::kSectorErase | flash::kWordSize | ((kFirstSector + slot) << flash::kSectorShift));
    set_bits<Bus>(flash::kCr, flash::kStart);
    const bool done = wait_idle();
    lock();
    drop_cached_data();
    return done;
  }

  bool write_word(std::uint32_t slot, std::uint32_t offset, std::uint32_t word) {
    if (!unlock()) return false;
    Bus::write(flash::kCr, flash::kProgram | flash::kWordSize);
    Bus::write(address_of(slot, offset), word);
    const bool done = wait_idle();
    lock();
    return done;
  }

  [[nodiscard]] std::uint32_t read_word(std::uint32_t slot, std::uint32_t offset) const {
    return Bus::read(address_of(slot, offset));
  }

 private:
  static constexpr std::uint32_t kFirstSector = 10;
  static constexpr std::uint32_t kFirstAddress = 0x080C0000U;
  static constexpr std::uint32_t kSectorBytes = 0x20000U;
  /// An erase takes at most 2 s, a poll at 168 MHz at least 5 cycles.
  static constexpr std::uint32_t kPolls = 70'000'000;

  static constexpr std::uint32_t address_of(std::uint32_t slot, std::uint32_t offset) {
    return kFirstAddress + slot * kSectorBytes + offset;
  }

  static bool unlock() {
    if ((Bus::read(flash::kCr) & flash::kLock) != 0) {
      Bus::write(flash::kKeyR, flash::kKey1);
      Bus::write(flash::kKeyR, flash::kKey2);
    }
    Bus::write(flash::kSr, flash::kErrors);
    return (Bus::read(flash::kCr) & flash::kLock) == 0;
  }

  static void lock() { Bus::write(flash::kCr, flash::kLock); }

  static bool wait_idle() {
    return wait_for<Bus>(flash::kSr, flash::kBusy, 0, kPolls) &&
           (Bus::read(flash::kSr) & flash::kErrors) == 0;
  }

  static void drop_cached_data() {
    const std::uint32_t acr = Bus::read(flash::kAcr);
    Bus::write(flash::kAcr, acr & ~flash::kDataCache);
    Bus::write(flash::kAcr, (acr & ~flash::kDataCache) | flash::kDataCacheReset);
    Bus::write(flash::kAcr, acr);
  }
};

}  // namespace morepro::firmware::f405
