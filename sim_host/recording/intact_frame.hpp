#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/frame/sensor_frame.hpp"
#include "lib/wire/byte_order.hpp"
#include "lib/wire/record_codec.hpp"
#include "sim_host/recording/frame_crc.hpp"

namespace morepro::host {

enum class FrameCheck : std::uint8_t {
  kCrc,   ///< nothing is known about the bytes
  kDone,  ///< the same bytes have passed the CRC before
};

/// Frames as wire::Decoder would give them, several times as fast: the decoder has to do with any byte at any
/// time, a recording is nearly all intact frames.
class IntactFrame {
 public:
  /// Takes the record at the front of `bytes`, up to its delimiter, where it is a frame. Otherwise takes
  /// nothing and returns false: the decoder says what there is. Right at the end of a file that is so too.
  bool take(std::span<const std::uint8_t>& bytes, FrameCheck check);

  [[nodiscard]] std::uint32_t sequence() const { return load<std::uint32_t>(1); }
  [[nodiscard]] std::uint32_t time_us() const { return load<std::uint32_t>(5); }
  [[nodiscard]] std::uint16_t present() const { return load<std::uint16_t>(9); }
  void read(SensorFrame& frame) const;

 private:
  static constexpr std::size_t kLongest = wire::kMaxEncodedSize<SensorFrame>;  // delimiter included
  // One copy of fixed length serves a record of any length.
  static constexpr std::size_t kCopied = 80;
  static_assert(kLongest <= kCopied && kLongest <= wire::kCobsLongestRun && kCopied <= kCrcLongest);

  template <class U>
  [[nodiscard]] U load(std::size_t offset) const {
    return wire::load_little_endian<U>(bytes_.data() + kCrcLead + offset);
  }
  static bool ends_at(std::span<const std::uint8_t> bytes, std::size_t size);
  static std::size_t find_end(std::span<const std::uint8_t> bytes);
  std::size_t unstuff(const std::uint8_t* stuffed, std::size_t size);
  [[nodiscard]] bool is_frame(std::size_t size) const;
  [[nodiscard]] bool passes_crc(std::size_t size) const;

  /// Zeros for the CRC, the record, and room for reading as many channels as there may be.
  std::array<std::uint8_t, kCrcLead + kCopied + sizeof(float) * kChannelCount> bytes_{};
  /// Most frames are as long as the one before: the next one is begun while this one is still checked.
  std::size_t expected_size_ = 0;
};

}  // namespace morepro::host
