#include "hal/two_slot_store.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "tests/support/check.hpp"

namespace morepro::hal {
namespace {

constexpr std::uint32_t kNever = 0xFFFFFFFFU;

/// Flash with a power supply that fails: at operation `cut_at` the erase or the word is done only in part,
/// after it nothing is done any more. `torn`: which bits of that last word arrive.
struct CutFlash {
  static constexpr std::uint32_t kWords = 32;

  std::array<std::array<std::uint32_t, kWords>, 2> words{};
  std::uint32_t operations = 0;
  std::uint32_t cut_at = kNever;
  std::uint32_t torn = 0;

  [[nodiscard]] std::uint32_t slot_bytes() const { return 4 * kWords; }
  [[nodiscard]] std::uint32_t read_word(std::uint32_t slot, std::uint32_t offset) const {
    return words[slot][offset / 4];
  }
  bool erase(std::uint32_t slot) {
    const std::uint32_t now = operations++;
    if (now > cut_at) return false;
    const std::uint32_t end = now == cut_at ? torn % kWords : kWords;
    for (std::uint32_t i = 0; i < end; ++i) words[slot][i] = 0xFFFFFFFFU;
    return now != cut_at;
  }
  bool write_word(std::uint32_t slot, std::uint32_t offset, std::uint32_t word) {
    const std::uint32_t now = operations++;
    if (now > cut_at) return false;
    words[slot][offset / 4] &= now == cut_at ? word | ~torn : word;
    return now != cut_at;
  }
};

using Store = TwoSlotStore<CutFlash, 100>;
using Record = std::array<std::uint8_t, 22>;

Record record(std::uint8_t seed) {
  Record bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(seed * 31U + i * 7U);
  return bytes;
}

bool holds(CutFlash flash, const Record& expected) {
  Store store(flash);
  Record found{};
  return store.load(found) == found.size() && found == expected;
}

CutFlash flash_with(std::uint8_t records) {
  CutFlash flash;
  for (std::uint8_t i = 1; i <= records; ++i) (void)Store(flash).store(record(i));
  flash.operations = 0;
  return flash;
}

TEST(TwoSlotStore, HoldsNothingAtFirst) {
  CutFlash blank;
  Record buffer{};
  EXPECT_EQ(Store(blank).load(buffer), 0U);
  for (auto& slot : blank.words) slot.fill(0xFFFFFFFFU);
  EXPECT_EQ(Store(blank).load(buffer), 0U);
}

TEST(TwoSlotStore, GivesTheNewestRecord) {
  for (std::uint8_t count = 1; count < 6; ++count) EXPECT_TRUE(holds(flash_with(count), record(count)));
}

TEST(TwoSlotStore, RefusesEmptyAndOversizedRecords) {
  CutFlash flash = flash_with(1);
  const std::array<std::uint8_t, 101> large{};
  EXPECT_FALSE(Store(flash).store({}));
  EXPECT_FALSE(Store(flash).store(large));
  EXPECT_TRUE(holds(flash, record(1)));
}

TEST(TwoSlotStore, KeepsTheOldOrTheNewRecordAtEveryCut) {
  const std::uint32_t torn_bits[] = {0, 0xFFFFFFFFU, 0xFFFFU, 0xFFFF0000U, 0x5A5A5A5AU, 1, 13, 0xFFFFFFFEU};
  for (std::uint8_t before = 1; before < 4; ++before)
    for (const std::uint32_t torn : torn_bits)
      for (std::uint32_t cut = 0; cut < 12; ++cut) {
        CutFlash flash = flash_with(before);
        flash.cut_at = cut;
        flash.torn = torn;
        const bool stored = Store(flash).store(record(77));
        EXPECT_TRUE(holds(flash, record(77)) || (!stored && holds(flash, record(before))))
            << "cut at " << cut;
      }
}

TEST(TwoSlotStore, StoresAgainAfterACut) {
  CutFlash flash = flash_with(2);
  flash.cut_at = 4;
  EXPECT_FALSE(Store(flash).store(record(77)));
  flash.cut_at = kNever;
  EXPECT_TRUE(Store(flash).store(record(78)));
  EXPECT_TRUE(holds(flash, record(78)));
}

TEST(TwoSlotStore, FindsEverySingleFlippedBit) {
  for (std::uint32_t word = 0; word < 9; ++word)
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
      CutFlash flash = flash_with(2);
      flash.words[1][word] ^= 1U << bit;
      EXPECT_TRUE(holds(flash, record(1)));
    }
}

/// Writes go nowhere, as in an emulator without a flash controller.
struct DeafFlash {
  [[nodiscard]] std::uint32_t slot_bytes() const { return 128; }
  [[nodiscard]] std::uint32_t read_word(std::uint32_t, std::uint32_t) const { return 0; }
  bool erase(std::uint32_t) { return true; }
  bool write_word(std::uint32_t, std::uint32_t, std::uint32_t) { return true; }
};

TEST(TwoSlotStore, SaysSoWhenTheMemoryDoesNotKeepWhatWasWritten) {
  DeafFlash flash;
  TwoSlotStore<DeafFlash, 100> store(flash);
  EXPECT_FALSE(store.store(record(1)));
}

TEST(TwoSlotStore, CountsOnOverTheWrapOfItsSequence) {
  CutFlash flash = flash_with(1);
  const std::uint32_t crc_at = 8 + 24;
  std::array<std::uint8_t, 32> image{};
  std::copy_n(record(1).begin(), 22, image.begin() + 8);
  wire::store_little_endian(image.data(), 0xFFFFFFFFU);
  wire::store_little_endian(image.data() + 4, 22U);
  for (std::uint32_t at = 0; at < crc_at; at += 4)
    flash.words[0][at / 4] = wire::load_little_endian<std::uint32_t>(image.data() + at);
  flash.words[0][crc_at / 4] = wire::crc32(image);
  EXPECT_TRUE(Store(flash).store(record(2)));
  EXPECT_TRUE(holds(flash, record(2)));
}

}  // namespace
}  // namespace morepro::hal
