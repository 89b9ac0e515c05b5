#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace morepro::firmware {

/// Bytes between one interrupt and one loop, in fixed memory. One side only writes, the other only reads.
/// The receiving driver masks its interrupt at the high-water mark and lets it in again at the low one, so
/// that a line without pauses cannot overflow it. kCapacity: a power of two.
template <std::size_t kCapacity>
class ByteRing {
  static_assert(kCapacity >= 16 && (kCapacity & (kCapacity - 1)) == 0);

 public:
  /// Writing side; false: full, the byte was not taken.
  bool push(std::uint8_t byte) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == kCapacity) return false;
    bytes_[head % kCapacity] = byte;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Writing side; takes all of `message` or nothing.
  bool push_all(std::span<const std::uint8_t> message) {
    if (message.size() > kCapacity - size()) return false;
    for (const std::uint8_t byte : message) push(byte);
    return true;
  }

  /// Reading side; false: empty.
  bool pop(std::uint8_t& byte) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    byte = bytes_[tail % kCapacity];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  [[nodiscard]] std::size_t size() const {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_acquire);
  }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Time to hold the sender: the last quarter is for what is under way.
  [[nodiscard]] bool above_high_water() const { return size() >= kCapacity / 4 * 3; }
  /// Time to let the sender go on.
  [[nodiscard]] bool below_low_water() const { return size() <= kCapacity / 4; }

 private:
  std::array<std::uint8_t, kCapacity> bytes_{};
  std::atomic<std::uint32_t> head_{0};
  std::atomic<std::uint32_t> tail_{0};
};

}  // namespace morepro::firmware
