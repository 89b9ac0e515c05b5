#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "lib/wire/cobs.hpp"
#include "lib/wire/configuration_codec.hpp"
#include "lib/wire/control_codec.hpp"
#include "lib/wire/crc32.hpp"
#include "lib/wire/frame_codec.hpp"
#include "lib/wire/health_codec.hpp"
#include "lib/wire/record.hpp"

namespace morepro::wire {

/// What a record can be; std::monostate: none was decoded yet.
using Record = std::variant<std::monostate, SensorFrame, Health, MonitorConfiguration, Ready, End, Text>;

/// Type byte and longest payload of a record T.
template <RecordType kTypeValue, std::size_t kPayload>
struct RecordLayout {
  static constexpr RecordType kType = kTypeValue;
  static constexpr std::size_t kMaxSize = kEnvelopeSize + kPayload;
  /// Buffer that encode() never finds too small, delimiter included.
  static constexpr std::size_t kMaxEncodedSize = cobs_encoded_bound(kMaxSize) + 1;
};

template <class T>
struct LayoutOf;
template <>
struct LayoutOf<SensorFrame> : RecordLayout<RecordType::kFrame, kMaxFramePayload> {};
template <>
struct LayoutOf<Health> : RecordLayout<RecordType::kHealth, kHealthPayload> {};
template <>
struct LayoutOf<MonitorConfiguration> : RecordLayout<RecordType::kConfiguration, kConfigurationPayload> {};
template <>
struct LayoutOf<Ready> : RecordLayout<RecordType::kReady, wire_size<Ready>()> {};
template <>
struct LayoutOf<End> : RecordLayout<RecordType::kEnd, wire_size<End>()> {};
template <>
struct LayoutOf<Text> : RecordLayout<RecordType::kText, Text::kMaxSize> {};

template <class T>
inline constexpr std::size_t kMaxEncodedSize = LayoutOf<T>::kMaxEncodedSize;

/// Longest decoded record of any type: the buffer of every receiver.
inline constexpr std::size_t kLargestRecord = std::max(
    {LayoutOf<SensorFrame>::kMaxSize, LayoutOf<Health>::kMaxSize, LayoutOf<MonitorConfiguration>::kMaxSize,
     LayoutOf<Ready>::kMaxSize, LayoutOf<End>::kMaxSize, LayoutOf<Text>::kMaxSize});
static_assert(kMaxEncodedSize<SensorFrame> <= 73, "a frame must fit through the link at the sampling rate");

/// One record, ready for the link: type, payload, CRC-32, stuffed, with its delimiter, into `out`.
/// Returns the size; 0: does not fit, or `record` holds what cannot be sent. May run in an interrupt.
template <class T>
[[nodiscard]] std::size_t encode(const T& record, std::span<std::uint8_t> out) {
  std::array<std::uint8_t, LayoutOf<T>::kMaxSize> plain;
  ByteWriter writer(plain);
  writer.put(static_cast<std::uint8_t>(LayoutOf<T>::kType));
  write_payload(writer, record);
  writer.put(crc32(writer.written()));
  if (!writer.ok() || out.empty()) return 0;
  const std::size_t size = cobs_encode(writer.written(), out.first(out.size() - 1));
  if (size == 0) return 0;
  out[size] = kDelimiter;
  return size + 1;
}

template <class T>
RecordFault decode_payload(std::span<const std::uint8_t> payload, Record& record) {
  ByteReader reader(payload);
  read_payload(reader, record.template emplace<T>());
  if (reader.is_rejected()) return RecordFault::kContent;
  return reader.is_complete() ? RecordFault::kNone : RecordFault::kLength;
}

/// Checks and decodes one record without its byte stuffing. On a fault `record` holds std::monostate.
[[nodiscard]] inline RecordFault decode_typed(RecordType type, std::span<const std::uint8_t> payload,
                                              Record& record) {
  switch (type) {
    case RecordType::kFrame:
      return decode_payload<SensorFrame>(payload, record);
    case RecordType::kHealth:
      return decode_payload<Health>(payload, record);
    case RecordType::kConfiguration:
      return decode_payload<MonitorConfiguration>(payload, record);
    case RecordType::kReady:
      return decode_payload<Ready>(payload, record);
    case RecordType::kEnd:
      return decode_payload<End>(payload, record);
    case RecordType::kText:
      return decode_payload<Text>(payload, record);
  }
  return RecordFault::kUnknownType;
}

/// Checks and decodes `plain`: type, payload, CRC-32. On a fault `record` holds std::monostate.
[[nodiscard]] inline RecordFault decode(std::span<const std::uint8_t> plain, Record& record) {
  RecordFault fault = RecordFault::kLength;
  if (plain.size() >= kEnvelopeSize) {
    const auto checked = plain.first(plain.size() - kCrcSize);
    const bool intact = crc32(checked) == load_little_endian<std::uint32_t>(plain.data() + checked.size());
    fault = intact ? decode_typed(static_cast<RecordType>(plain.front()), checked.subspan(kTypeSize), record)
                   : RecordFault::kCrc;
  }
  if (fault != RecordFault::kNone) record.emplace<std::monostate>();
  return fault;
}

}  // namespace morepro::wire
