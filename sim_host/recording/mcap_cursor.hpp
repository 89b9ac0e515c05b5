#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lib/wire/byte_order.hpp"
#include "sim_host/recording/mcap_record.hpp"

namespace morepro::host {

/// Takes little-endian values from untrusted bytes. Past the end it gives zeros and nothing, and is_intact()
/// stays false.
class McapCursor {
 public:
  explicit McapCursor(std::string_view bytes) : rest_(bytes) {}

  /// A whole record lies in front.
  [[nodiscard]] bool has_record() const {
    if (rest_.size() < kMcapRecordHead) return false;
    const auto* size = reinterpret_cast<const std::uint8_t*>(rest_.data()) + 1;
    return wire::load_little_endian<std::uint64_t>(size) <= rest_.size() - kMcapRecordHead;
  }

  template <std::unsigned_integral U>
  U get() {
    const std::string_view bytes = get_bytes(sizeof(U));
    return bytes.empty() ? U{0}
                         : wire::load_little_endian<U>(reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }

  std::string_view get_bytes(std::uint64_t count) {
    if (count > rest_.size()) {
      is_intact_ = false;
      rest_ = {};
      return {};
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view get_text() { return get_bytes(get<std::uint32_t>()); }

  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] bool is_empty() const { return rest_.empty(); }
  [[nodiscard]] bool is_intact() const { return is_intact_; }

 private:
  std::string_view rest_;
  bool is_intact_ = true;
};

}  // namespace morepro::host
