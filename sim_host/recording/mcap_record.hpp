#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lib/wire/byte_order.hpp"

namespace morepro::host {

/// First and last bytes of a file, with the format's major version.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
inline constexpr std::string_view kMcapTopic = "/morepro/frame";
inline constexpr std::string_view kMcapSchemaName = "morepro.Frame";
/// Name of the metadata record that holds the metadata of a recording.
inline constexpr std::string_view kMcapMetadataName = "morepro";

/// Kind of a record (mcap.dev/spec).
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::size_t kMcapRecordHead = 1 + 8;

/// Little-endian values one after the other.
class McapBytes {
 public:
  template <std::unsigned_integral U>
  McapBytes& put(U value) {
    std::uint8_t bytes[sizeof(U)];
    wire::store_little_endian(bytes, value);
    bytes_.append(reinterpret_cast<const char*>(bytes), sizeof(U));
    return *this;
  }
  /// With its length in front, as are maps, arrays and texts.
  McapBytes& put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    return append(text);
  }
  /// Kind, length, content.
  McapBytes& put_record(McapOp op, std::string_view content) {
    put(static_cast<std::uint8_t>(op)).put(std::uint64_t{content.size()});
    return append(content);
  }
  McapBytes& append(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  void clear() { bytes_.clear(); }

  [[nodiscard]] std::string_view view() const { return bytes_; }
  [[nodiscard]] std::uint64_t size() const { return bytes_.size(); }

 private:
  std::string bytes_;
};

}  // namespace morepro::host
