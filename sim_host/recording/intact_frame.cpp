#include "sim_host/recording/intact_frame.hpp"

#include <bit>
#include <cstring>

namespace morepro::host {

bool IntactFrame::take(std::span<const std::uint8_t>& bytes, FrameCheck check) {
  if (bytes.size() < kCopied + 1) return false;
  if (!ends_at(bytes, expected_size_)) expected_size_ = find_end(bytes);
  const std::size_t stuffed_size = expected_size_;
  if (stuffed_size == 0) return false;
  const std::size_t size = unstuff(bytes.data(), stuffed_size);
  if (!is_frame(size) || (check == FrameCheck::kCrc && !passes_crc(size))) return false;
  bytes = bytes.subspan(stuffed_size + 1);
  return true;
}

bool IntactFrame::ends_at(std::span<const std::uint8_t> bytes, std::size_t size) {
  return bytes[size] == wire::kDelimiter && std::memchr(bytes.data(), wire::kDelimiter, size) == nullptr;
}

std::size_t IntactFrame::find_end(std::span<const std::uint8_t> bytes) {
  const auto* end = static_cast<const std::uint8_t*>(std::memchr(bytes.data(), wire::kDelimiter, kLongest));
  return end == nullptr ? 0 : static_cast<std::size_t>(end - bytes.data());
}

// Records are shorter than the longest run: every code byte stands in the place of a zero. Returns the
// decoded size; 0: the code bytes do not end with the record.
std::size_t IntactFrame::unstuff(const std::uint8_t* stuffed, std::size_t size) {
  std::uint8_t* plain = bytes_.data() + kCrcLead;
  std::memcpy(plain, stuffed + 1, kCopied);
  std::size_t place = stuffed[0];
  for (; place < size; place += stuffed[place]) plain[place - 1] = 0;
  return place == size ? size - 1 : 0;
}

bool IntactFrame::is_frame(std::size_t size) const {
  constexpr std::size_t kEmptySize = wire::kEnvelopeSize + wire::kFrameHeaderSize;
  if (size < kEmptySize || load<std::uint8_t>(0) != static_cast<std::uint8_t>(wire::RecordType::kFrame))
    return false;
  const std::uint32_t channels = present();
  return (channels & ~std::uint32_t{wire::kEveryChannel}) == 0 &&
         size == kEmptySize + sizeof(float) * static_cast<std::size_t>(std::popcount(channels));
}

bool IntactFrame::passes_crc(std::size_t size) const {
  const std::size_t checked = size - wire::kCrcSize;
  return frame_crc32(bytes_.data() + kCrcLead, checked) == load<std::uint32_t>(checked);
}

void IntactFrame::read(SensorFrame& frame) const {
  frame.sequence = sequence();
  frame.time_us = time_us();
  frame.present = present();
  std::size_t offset = wire::kTypeSize + wire::kFrameHeaderSize;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const std::uint32_t is_there = (std::uint32_t{frame.present} >> i) & 1U;
    frame.value[i] = std::bit_cast<float>(load<std::uint32_t>(offset) & (0U - is_there));
    offset += sizeof(float) * is_there;
  }
}

}  // namespace morepro::host
