#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "lib/wire/byte_order.hpp"

namespace morepro::wire {

/// Puts little-endian values into the caller's bytes. What does not fit is not written, and ok() stays false.
class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> bytes) : bytes_(bytes) {}

  template <std::unsigned_integral U>
  void put(U value) {
    if (std::uint8_t* place = reserve(sizeof(U))) store_little_endian(place, value);
  }

  void put_bytes(std::span<const std::uint8_t> source) {
    if (std::uint8_t* place = reserve(source.size()); place && !source.empty())
      std::memcpy(place, source.data(), source.size());
  }

  /// The next `count` bytes, for the caller to fill; nullptr where they do not fit.
  [[nodiscard]] std::uint8_t* reserve(std::size_t count) {
    if (!ok_ || count > bytes_.size() - size_) {
      ok_ = false;
      return nullptr;
    }
    std::uint8_t* place = bytes_.data() + size_;
    size_ += count;
    return place;
  }

  /// Says that the value cannot be encoded at all.
  void reject() { ok_ = false; }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::span<const std::uint8_t> written() const { return bytes_.first(size_); }

 private:
  std::span<std::uint8_t> bytes_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

/// Takes little-endian values from untrusted bytes. Past the end it gives zeros, and is_complete() stays
/// false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <std::unsigned_integral U>
  [[nodiscard]] U get() {
    const auto bytes = take(sizeof(U));
    return bytes.empty() ? U{0} : load_little_endian<U>(bytes.data());
  }

  /// The next `count` bytes; empty where there are fewer.
  [[nodiscard]] std::span<const std::uint8_t> take(std::size_t count) {
    if (overrun_ || count > rest_.size()) {
      overrun_ = true;
      return {};
    }
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  /// Says that a value was read that means nothing.
  void reject() { rejected_ = true; }

  [[nodiscard]] std::size_t remaining() const { return rest_.size(); }
  /// Every byte was taken and none was missing.
  [[nodiscard]] bool is_complete() const { return !overrun_ && rest_.empty(); }
  [[nodiscard]] bool is_rejected() const { return rejected_; }

 private:
  std::span<const std::uint8_t> rest_;
  bool overrun_ = false;
  bool rejected_ = false;
};

}  // namespace morepro::wire
