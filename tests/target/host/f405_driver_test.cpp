#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "firmware/boards/almec/almec_board_pins.hpp"
#include "firmware/boards/almec/f405_clock.hpp"
#include "firmware/boards/almec/f405_flash.hpp"
#include "firmware/boards/almec/f405_usart.hpp"
#include "firmware/boards/almec/f405_watchdog.hpp"
#include "hal/two_slot_store.hpp"

namespace morepro::firmware::f405 {
namespace {

/// Registers of the part as its reference manual describes them, where the emulator has none: reset and clock
/// control, flash controller, independent watchdog.
struct Part {
  std::map<std::uint32_t, std::uint32_t> words;
  bool crystal_works = true;
  bool locked = true;
  std::uint32_t last_key = 0;
  std::uint32_t faults = 0;  ///< accesses that the part would not have done
  bool watchdog_unlocked = false;
  std::vector<std::uint32_t> erased_sectors;
};
Part part;

bool is_flash(std::uint32_t address) { return address >= 0x08000000U && address < 0x08100000U; }

struct PartBus {
  static std::uint32_t read(std::uint32_t address) {
    if (is_flash(address) && !part.words.contains(address)) return 0xFFFFFFFFU;
    const std::uint32_t word = part.words[address];
    if (address == rcc::kCr) return with_ready_flags(word);
    if (address == rcc::kCfgr) return word | ((word & rcc::kSwitchMask) << 2);
    if (address == flash::kCr) return part.locked ? word | flash::kLock : word & ~flash::kLock;
    return word;
  }

  static void write(std::uint32_t address, std::uint32_t value) {
    if (address == flash::kKeyR) return take_key(value);
    if (address == flash::kCr) return control_flash(value);
    if (address == flash::kSr) return;
    if (address == iwdg::kKr) part.watchdog_unlocked = value == iwdg::kUnlock;
    if ((address == iwdg::kPr || address == iwdg::kRlr) && !part.watchdog_unlocked) ++part.faults;
    if (is_flash(address)) return program(address, value);
    part.words[address] = value;
  }

 private:
  static std::uint32_t with_ready_flags(std::uint32_t word) {
    if ((word & rcc::kHseOn) != 0 && part.crystal_works) word |= rcc::kHseReady;
    if ((word & rcc::kPllOn) != 0) word |= rcc::kPllReady;
    return word;
  }
  static void take_key(std::uint32_t key) {
    if (key == flash::kKey2 && part.last_key == flash::kKey1) part.locked = false;
    part.last_key = key;
  }
  static void control_flash(std::uint32_t value) {
    if (part.locked) {
      ++part.faults;
      return;
    }
    if ((value & flash::kLock) != 0) part.locked = true;
    if ((value & flash::kSectorErase) != 0 && (value & flash::kStart) != 0) erase((value >> 3) & 15U);
    part.words[flash::kCr] = value;
  }
  static void erase(std::uint32_t sector) {
    part.erased_sectors.push_back(sector);
    const std::uint32_t first = 0x08020000U + (sector - 5) * 0x20000U;
    std::erase_if(part.words,
                  [&](const auto& word) { return word.first >= first && word.first < first + 0x20000U; });
  }
  static void program(std::uint32_t address, std::uint32_t value) {
    const bool allowed = !part.locked && (part.words[flash::kCr] & flash::kProgram) != 0;
    part.faults += allowed ? 0U : 1U;
    if (allowed) part.words[address] = read(address) & value;
  }
};

class F405 : public testing::Test {
 protected:
  void SetUp() override { part = Part{}; }
};

TEST_F(F405, RunsAt168MegahertzFromTheCrystal) {
  EXPECT_EQ(start_clock<PartBus>(almec::kCrystalHz).core_hz, 168'000'000U);
  const std::uint32_t pll = part.words[rcc::kPllCfgr];
  EXPECT_EQ(almec::kCrystalHz / (pll & 63U) * ((pll >> 6) & 511U) / 2, 168'000'000U);
  EXPECT_EQ(part.words[flash::kAcr] & 7U, 5U);
}

TEST_F(F405, GoesOnWithItsInternalOscillatorWhenTheCrystalIsDead) {
  part.crystal_works = false;
  EXPECT_EQ(start_clock<PartBus>(almec::kCrystalHz).core_hz, 16'000'000U);
  EXPECT_EQ(part.words[rcc::kCfgr] & rcc::kSwitchMask, 0U);
}

TEST_F(F405, CountsMicroseconds) {
  start_microseconds<PartBus>(kFullSpeed);
  EXPECT_EQ(kFullSpeed.apb1_timer_hz / (part.words[tim2::kPsc] + 1), 1'000'000U);
}

TEST_F(F405, DividesTheClockToTheLinkBaudRateExactly) {
  const std::uint32_t divider = baud_divider(kFullSpeed.apb2_hz, almec::kLinkBaud);
  const std::uint32_t eighths = (divider >> 4) * 8 + (divider & 7U);
  EXPECT_EQ(kFullSpeed.apb2_hz / eighths, almec::kLinkBaud);
}

TEST_F(F405, SetsTheWatchdogToTheTimeThatWasAsked) {
  for (const std::uint32_t wanted_ms : {20U, 100U, 1000U, 10'000U, 32'000U}) {
    Watchdog<PartBus>().start(wanted_ms);
    const double ms = (part.words[iwdg::kRlr] + 1) * (4U << part.words[iwdg::kPr]) / 32.0;
    EXPECT_NEAR(ms, wanted_ms, 0.01 * wanted_ms);
    EXPECT_LE(part.words[iwdg::kRlr], 4095U);
  }
  EXPECT_EQ(part.faults, 0U);
}

TEST_F(F405, TellsWhyItStartedAndClearsTheFlags) {
  part.words[rcc::kCsr] = rcc::kWatchdogReset | (1U << 26);
  EXPECT_EQ(take_reset_cause<PartBus>(), hal::ResetCause::kWatchdog);
  EXPECT_NE(part.words[rcc::kCsr] & rcc::kRemoveResetFlags, 0U);
  part.words[rcc::kCsr] = rcc::kSoftwareReset;
  EXPECT_EQ(take_reset_cause<PartBus>(), hal::ResetCause::kSoftware);
  part.words[rcc::kCsr] = rcc::kPowerOnReset;
  EXPECT_EQ(take_reset_cause<PartBus>(), hal::ResetCause::kPowerOn);
  part.words[rcc::kCsr] = 0;
  EXPECT_EQ(take_reset_cause<PartBus>(), hal::ResetCause::kUnknown);
}

TEST_F(F405, KeepsRecordsInTheLastTwoSectorsAndLocksTheFlashAgain) {
  StoreFlash<PartBus> flash;
  hal::TwoSlotStore<StoreFlash<PartBus>, 1024> store(flash);
  std::vector<std::uint8_t> record(700, 0x35), found(700);
  for (std::uint8_t round = 0; round < 4; ++round) {
    record[0] = round;
    ASSERT_TRUE(store.store(record));
    ASSERT_EQ(store.load(found), record.size());
    EXPECT_EQ(found, record);
    EXPECT_TRUE(part.locked);
  }
  EXPECT_EQ(part.erased_sectors, (std::vector<std::uint32_t>{10, 11, 10, 11}));
  EXPECT_EQ(part.faults, 0U);
}

}  // namespace
}  // namespace morepro::firmware::f405
