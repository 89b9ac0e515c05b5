#include "sim_host/support/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace morepro::host {
namespace {

constexpr std::size_t kMostBytes = 1000;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Bytes of the character that `text` begins with; 0: none that can be shown.
std::size_t character_size(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t size = first >= 0xC2 && first < 0xE0   ? 2
                           : first >= 0xE0 && first < 0xF0 ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  if (size == 0 || size > text.size()) return 0;
  // U+0080 .. U+009F are control characters, too.
  if (first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0) return 0;
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(size), is_continuation)
             ? size
             : 0;
}

std::string escaped(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    if (size == 0) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else {
      shown += text.substr(0, size);
    }
    text.remove_prefix(std::max(size, std::size_t{1}));
  }
  return shown;
}

}  // namespace

std::string printable(std::string_view text) {
  if (text.size() <= kMostBytes) return escaped(text);
  return escaped(text.substr(0, kMostBytes / 2)) + " ... " +
         escaped(text.substr(text.size() - kMostBytes / 2));
}

}  // namespace morepro::host
