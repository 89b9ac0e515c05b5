#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace morepro::wire {

/// Version of this protocol, sent in Ready. It changes with any change of framing or of a record's meaning.
inline constexpr std::uint8_t kProtocolVersion = 3;

/// First byte of every record. The numbers are fixed: recordings hold them.
enum class RecordType : std::uint8_t {
  kFrame = 1,
  kHealth = 2,
  kConfiguration = 3,
  kReady = 4,
  kEnd = 5,
  kText = 6,
};

inline constexpr std::size_t kTypeSize = 1;
inline constexpr std::size_t kCrcSize = 4;
inline constexpr std::size_t kEnvelopeSize = kTypeSize + kCrcSize;

/// The firmware says it once after its start: from now on it listens.
struct Ready {
  std::uint8_t protocol_version = kProtocolVersion;
  std::uint32_t build_id = 0;
  std::uint8_t reset_cause = 0;  ///< hal::ResetCause
};

/// Closes a recording. Without it the recording was cut.
struct End {
  std::uint32_t frames = 0;  ///< frames written before, wraps
};

/// One `key: value` of a recording's metadata, UTF-8 without control characters.
struct Text {
  static constexpr std::size_t kMaxSize = 200;

  std::uint8_t size = 0;
  std::array<char, kMaxSize> bytes{};

  [[nodiscard]] std::string_view view() const {
    return {bytes.data(), std::min<std::size_t>(size, kMaxSize)};
  }

  /// Takes `text`; false and unchanged: too long, or it holds a control character.
  [[nodiscard]] bool assign(std::string_view text) {
    if (text.size() > kMaxSize || std::any_of(text.begin(), text.end(), [](char c) { return is_control(c); }))
      return false;
    size = static_cast<std::uint8_t>(text.size());
    bytes = {};
    std::copy(text.begin(), text.end(), bytes.begin());
    return true;
  }

 private:
  static constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }
};

/// Why something between two delimiters is no record.
enum class RecordFault : std::uint8_t {
  kNone = 0,
  kCobs = 1,         ///< the byte stuffing is broken: bytes were lost or changed
  kLength = 2,       ///< too short, too long, or not the length that its type has
  kCrc = 3,          ///< the check sum does not fit
  kUnknownType = 4,  ///< intact, but of a type that this version does not know
  kContent = 5,      ///< intact, but a field holds what its type does not allow
};

/// Dropped records by cause; each count wraps.
struct CorruptCounts {
  std::uint32_t cobs = 0;
  std::uint32_t length = 0;
  std::uint32_t crc = 0;
  std::uint32_t unknown_type = 0;
  std::uint32_t content = 0;

  void count(RecordFault fault) {
    switch (fault) {
      case RecordFault::kNone:
        return;
      case RecordFault::kCobs:
        ++cobs;
        return;
      case RecordFault::kLength:
        ++length;
        return;
      case RecordFault::kCrc:
        ++crc;
        return;
      case RecordFault::kUnknownType:
        ++unknown_type;
        return;
      case RecordFault::kContent:
        ++content;
        return;
    }
  }
  [[nodiscard]] std::uint32_t total() const { return cobs + length + crc + unknown_type + content; }

  friend bool operator==(const CorruptCounts&, const CorruptCounts&) = default;
};

}  // namespace morepro::wire
