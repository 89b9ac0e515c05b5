#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "lib/wire/byte_order.hpp"
#include "lib/wire/crc32.hpp"

namespace morepro::hal {

/// Two areas that keep 32-bit words without power. Offsets are in bytes, multiples of 4, below slot_bytes().
/// A call that returns false may have done its work partly.
template <class F>
concept FlashLike = requires(F flash, const F& readable, std::uint32_t slot, std::uint32_t offset,
                             std::uint32_t word) {
  { readable.slot_bytes() } -> std::convertible_to<std::uint32_t>;
  { flash.erase(slot) } -> std::same_as<bool>;
  { flash.write_word(slot, offset, word) } -> std::same_as<bool>;
  { readable.read_word(slot, offset) } -> std::same_as<std::uint32_t>;
};

/// Keeps one record through power cuts: whatever instant the power goes at, load() gives the old record or
/// the new one, whole. The slot that holds the newest record is never touched; the other one is erased and
/// written, its check sum last. kCapacity: longest record in bytes. A slot: sequence, length, the record in
/// words, CRC-32 of everything before it; all little-endian.
template <FlashLike F, std::size_t kCapacity>
class TwoSlotStore {
  static_assert(kCapacity % 4 == 0);

 public:
  explicit TwoSlotStore(F& flash) : flash_(flash) {}

  /// Copies the newest whole record into `buffer`; returns its length, 0: none, or longer than the buffer.
  [[nodiscard]] std::size_t load(std::span<std::uint8_t> buffer) {
    const Newest newest = find_newest();
    if (!newest.exists || !read_slot(newest.slot)) return 0;
    const std::size_t length = length_in_image();
    if (length > buffer.size()) return 0;
    std::memcpy(buffer.data(), image_.data() + kHeaderBytes, length);
    return length;
  }

  /// False: empty, too long, or the memory does not hold what was written; then the old record is still
  /// there.
  [[nodiscard]] bool store(std::span<const std::uint8_t> record) {
    if (record.empty() || record.size() > capacity()) return false;
    const Newest newest = find_newest();
    const std::uint32_t slot = newest.exists ? 1 - newest.slot : 0;
    fill_image(newest.sequence + 1, record);
    return flash_.erase(slot) && write_image(slot, record.size()) && holds(slot, record);
  }

  [[nodiscard]] std::size_t capacity() const {
    const std::size_t room = flash_.slot_bytes() - kHeaderBytes - kCrcBytes;
    return room < kCapacity ? room : kCapacity;
  }

 private:
  static constexpr std::size_t kHeaderBytes = 8, kCrcBytes = 4;

  struct Newest {
    bool exists = false;
    std::uint32_t slot = 0;
    std::uint32_t sequence = 0;
  };

  static constexpr std::size_t whole_words(std::size_t bytes) { return (bytes + 3) / 4 * 4; }
  [[nodiscard]] std::uint32_t word_in_image(std::size_t at) const {
    return wire::load_little_endian<std::uint32_t>(image_.data() + at);
  }
  [[nodiscard]] std::size_t length_in_image() const { return word_in_image(4); }

  Newest find_newest() {
    Newest newest;
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      if (!read_slot(slot)) continue;
      const std::uint32_t sequence = word_in_image(0);
      if (!newest.exists || static_cast<std::int32_t>(sequence - newest.sequence) > 0)
        newest = {.exists = true, .slot = slot, .sequence = sequence};
    }
    return newest;
  }

  /// Reads a slot into image_; true: what is there is whole.
  bool read_slot(std::uint32_t slot) {
    read_words(slot, 0, kHeaderBytes);
    const std::size_t length = length_in_image();
    if (length == 0 || length > capacity()) return false;
    const std::size_t end = kHeaderBytes + whole_words(length);
    read_words(slot, kHeaderBytes, end);
    return flash_.read_word(slot, static_cast<std::uint32_t>(end)) ==
           wire::crc32(std::span(image_).first(end));
  }

  void read_words(std::uint32_t slot, std::size_t from, std::size_t to) {
    for (std::size_t at = from; at < to; at += 4)
      wire::store_little_endian(image_.data() + at, flash_.read_word(slot, static_cast<std::uint32_t>(at)));
  }

  void fill_image(std::uint32_t sequence, std::span<const std::uint8_t> record) {
    image_.fill(0);
    wire::store_little_endian(image_.data(), sequence);
    wire::store_little_endian(image_.data() + 4, static_cast<std::uint32_t>(record.size()));
    std::memcpy(image_.data() + kHeaderBytes, record.data(), record.size());
  }

  bool write_image(std::uint32_t slot, std::size_t length) {
    const std::size_t end = kHeaderBytes + whole_words(length);
    for (std::size_t at = 0; at < end; at += 4)
      if (!flash_.write_word(slot, static_cast<std::uint32_t>(at), word_in_image(at))) return false;
    return flash_.write_word(slot, static_cast<std::uint32_t>(end),
                             wire::crc32(std::span(image_).first(end)));
  }

  bool holds(std::uint32_t slot, std::span<const std::uint8_t> record) {
    return read_slot(slot) && length_in_image() == record.size() &&
           std::memcmp(image_.data() + kHeaderBytes, record.data(), record.size()) == 0;
  }

  F& flash_;
  std::array<std::uint8_t, kHeaderBytes + kCapacity> image_{};
};

}  // namespace morepro::hal
