#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "lib/frame/sensor_frame.hpp"
#include "lib/wire/byte_stream.hpp"
#include "lib/wire/field_list.hpp"

namespace morepro::wire {

static_assert(field_count<SensorFrame>() == 4, "SensorFrame has a field that the wire does not carry");

inline constexpr std::size_t kFrameHeaderSize = 4 + 4 + 2;
inline constexpr std::size_t kMaxFramePayload = kFrameHeaderSize + 4 * kChannelCount;
inline constexpr std::uint16_t kEveryChannel = (1U << kChannelCount) - 1U;

/// Values are sent bit for bit, NaN included: a recording is evidence of what a sensor gave.
inline void write_payload(ByteWriter& writer, const SensorFrame& frame) {
  if ((frame.present & ~kEveryChannel) != 0) return writer.reject();
  writer.put(frame.sequence);
  writer.put(frame.time_us);
  writer.put(frame.present);
  for (unsigned bits = frame.present; bits != 0; bits &= bits - 1)
    writer.put(std::bit_cast<std::uint32_t>(frame.value[static_cast<std::size_t>(std::countr_zero(bits))]));
}

/// Expects `frame` as constructed: a channel that is not present stays 0.
inline void read_payload(ByteReader& reader, SensorFrame& frame) {
  frame.sequence = reader.get<std::uint32_t>();
  frame.time_us = reader.get<std::uint32_t>();
  frame.present = reader.get<std::uint16_t>();
  if ((frame.present & ~kEveryChannel) != 0) return reader.reject();
  const auto values = reader.take(4 * static_cast<std::size_t>(std::popcount(frame.present)));
  if (values.empty()) return;
  const std::uint8_t* next = values.data();
  for (unsigned bits = frame.present; bits != 0; bits &= bits - 1, next += 4)
    frame.value[static_cast<std::size_t>(std::countr_zero(bits))] =
        std::bit_cast<float>(load_little_endian<std::uint32_t>(next));
}

}  // namespace morepro::wire
