#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace morepro::firmware {

/// Bytes between one interrupt and one loop of the same core, in fixed memory. One side only writes, the
/// other only reads; an interrupt sees memory in program order, so that the compiler is all that has to be
/// held back. The receiving driver masks its interrupt at the high-water mark and lets it in again at the low
/// one, so that a line without pauses cannot overflow it. kCapacity: a power of two.
template <std::size_t kCapacity>
class ByteRing {
  static_assert(kCapacity >= 16 && (kCapacity & (kCapacity - 1)) == 0);

 public:
  /// Writing side; false: full, the byte was not taken.
  bool push(std::uint8_t byte) {
    const std::uint32_t head = load(head_);
    if (head - load(tail_) == kCapacity) return false;
    bytes_[head % kCapacity] = byte;
    publish(head_, head + 1);
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
    const std::span<const std::uint8_t> bytes = front();
    if (bytes.empty()) return false;
    byte = bytes.front();
    drop(1);
    return true;
  }

  /// Reading side: the oldest bytes that lie side by side; more may follow behind the ring's end.
  [[nodiscard]] std::span<const std::uint8_t> front() const {
    const std::uint32_t tail = load(tail_);
    const std::uint32_t first = tail % kCapacity;
    return std::span(bytes_).subspan(first, std::min<std::size_t>(load(head_) - tail, kCapacity - first));
  }

  /// Reading side: `count` bytes of front() are done with.
  void drop(std::size_t count) { publish(tail_, load(tail_) + static_cast<std::uint32_t>(count)); }

  [[nodiscard]] std::size_t size() const { return load(head_) - load(tail_); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// Time to hold the sender: the last quarter is for what is under way.
  [[nodiscard]] bool above_high_water() const { return size() >= kCapacity / 4 * 3; }
  /// Time to let the sender go on.
  [[nodiscard]] bool below_low_water() const { return size() <= kCapacity / 4; }

 private:
  using Counter = std::atomic<std::uint32_t>;

  static std::uint32_t load(const Counter& counter) {
    const std::uint32_t value = counter.load(std::memory_order_relaxed);
    std::atomic_signal_fence(std::memory_order_acquire);
    return value;
  }
  static void publish(Counter& counter, std::uint32_t value) {
    std::atomic_signal_fence(std::memory_order_release);
    counter.store(value, std::memory_order_relaxed);
  }

  std::array<std::uint8_t, kCapacity> bytes_{};
  Counter head_{0};
  Counter tail_{0};
};

}  // namespace morepro::firmware
