#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace morepro::wire {

/// Ends every record on the link and occurs nowhere else.
inline constexpr std::uint8_t kDelimiter = 0x00;

/// Longest run that one code byte announces; a full run has no zero after it.
inline constexpr std::size_t kCobsLongestRun = 254;

/// Most bytes that `size` bytes can become, without the delimiter.
constexpr std::size_t cobs_encoded_bound(std::size_t size) { return size + size / kCobsLongestRun + 1; }

/// Consistent overhead byte stuffing (Cheshire and Baker, 1999): `plain` without its zeros into `out`.
/// Returns the encoded size without a delimiter; 0: does not fit.
[[nodiscard]] inline std::size_t cobs_encode(std::span<const std::uint8_t> plain,
                                             std::span<std::uint8_t> out) {
  std::size_t used = 0;
  while (true) {
    const auto window = plain.first(std::min(plain.size(), kCobsLongestRun));
    const auto run = static_cast<std::size_t>(std::find(window.begin(), window.end(), 0) - window.begin());
    if (out.size() - used < run + 1) return 0;
    out[used] = static_cast<std::uint8_t>(run + 1);
    std::copy_n(plain.begin(), run, out.begin() + static_cast<std::ptrdiff_t>(used + 1));
    used += run + 1;
    plain = plain.subspan(run);
    if (plain.empty()) return used;
    if (run < kCobsLongestRun) plain = plain.subspan(1);
  }
}

enum class CobsStatus : std::uint8_t {
  kOk = 0,
  kBroken = 1,   ///< a code byte announces more bytes than there are
  kTooLong = 2,  ///< the decoded bytes do not fit
};

struct CobsResult {
  CobsStatus status = CobsStatus::kOk;
  std::size_t size = 0;
};

/// Copies a run. Most runs are short: a copy of fixed length, where there is room for it, is several times
/// faster than a call with the exact one; what it writes too much is overwritten by what follows.
inline void cobs_copy_run(std::span<const std::uint8_t> from, std::span<std::uint8_t> to, std::size_t run) {
  constexpr std::size_t kBlock = 16;
  if (run <= kBlock && from.size() >= kBlock && to.size() >= kBlock)
    std::memcpy(to.data(), from.data(), kBlock);
  else if (run != 0)
    std::memcpy(to.data(), from.data(), run);
}

/// Inverse of cobs_encode for one whole record without its delimiter; `out` must not overlap `encoded`.
/// Bytes of `out` behind the result may be changed.
[[nodiscard]] inline CobsResult cobs_decode(std::span<const std::uint8_t> encoded,
                                            std::span<std::uint8_t> out) {
  std::size_t size = 0;
  bool zero_due = false;
  while (!encoded.empty()) {
    if (zero_due) {
      if (size == out.size()) return {CobsStatus::kTooLong, size};
      out[size++] = 0;
    }
    const std::uint8_t code = encoded.front();
    encoded = encoded.subspan(1);
    if (code == 0) return {CobsStatus::kBroken, size};
    const std::size_t announced = code - 1U;
    const std::size_t run = std::min(announced, encoded.size());
    if (run > out.size() - size) return {CobsStatus::kTooLong, size};
    if (run != announced) return {CobsStatus::kBroken, size};
    cobs_copy_run(encoded, out.subspan(size), run);
    encoded = encoded.subspan(run);
    size += run;
    zero_due = announced != kCobsLongestRun;
  }
  return {CobsStatus::kOk, size};
}

/// The same, one byte at a time, into its own memory of kCapacity bytes: for a receive interrupt.
template <std::size_t kCapacity>
class CobsStream {
 public:
  /// Takes one byte that is not the delimiter.
  void push(std::uint8_t byte) {
    is_empty_ = false;
    if (run_left_ == 0) return begin_run(byte);
    append(byte);
    --run_left_;
  }

  /// What the bytes since the last call were; the next byte begins a new record.
  CobsResult finish() {
    CobsResult result = result_;
    if (result.status == CobsStatus::kOk && run_left_ != 0) result.status = CobsStatus::kBroken;
    result_ = {};
    run_left_ = 0;
    zero_due_ = false;
    is_empty_ = true;
    return result;
  }

  /// A whole record at once, where it lies in one piece; only while is_empty().
  CobsResult decode(std::span<const std::uint8_t> encoded) { return cobs_decode(encoded, bytes_); }

  /// No byte since the last finish().
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  /// The first `size` decoded bytes, valid until the next push() or decode().
  [[nodiscard]] std::span<const std::uint8_t> decoded(std::size_t size) const {
    return std::span(bytes_).first(size);
  }

 private:
  void begin_run(std::uint8_t code) {
    if (zero_due_) append(0);
    run_left_ = code - 1U;
    zero_due_ = run_left_ != kCobsLongestRun;
  }

  void append(std::uint8_t byte) {
    if (result_.size == kCapacity)
      result_.status = CobsStatus::kTooLong;
    else
      bytes_[result_.size++] = byte;
  }

  std::array<std::uint8_t, kCapacity> bytes_{};
  CobsResult result_;
  std::size_t run_left_ = 0;
  bool zero_due_ = false;
  bool is_empty_ = true;
};

}  // namespace morepro::wire
