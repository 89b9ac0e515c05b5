#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "lib/wire/decoder.hpp"

namespace morepro::wire_test {

using Bytes = std::vector<std::uint8_t>;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t operator()() { return static_cast<std::uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

template <class T>
Bytes encoded(const T& record) {
  Bytes bytes(wire::kMaxEncodedSize<T>);
  bytes.resize(wire::encode(record, bytes));
  return bytes;
}

/// Any bit pattern, NaN and infinities included, in any subset of the channels.
inline SensorFrame random_frame(Random& random) {
  SensorFrame frame;
  frame.sequence = random();
  frame.time_us = random();
  for (std::size_t k = 0; k < kChannelCount; ++k)
    if (random() % 2 == 0)
      frame.set(static_cast<Channel>(k), random() % 4 == 0 ? 0.0F : std::bit_cast<float>(random()));
  return frame;
}

/// The same in every byte that is sent; also where a value is NaN.
template <class T>
bool same(const T& a, const T& b) {
  return encoded(a) == encoded(b);
}

/// What a decoder said about a stream.
struct Transcript {
  std::vector<wire::DecodeEvent> events;
  std::vector<Bytes> records;  ///< encoded again
  wire::CorruptCounts corrupt;
  bool cut = false;

  friend bool operator==(const Transcript&, const Transcript&) = default;
};

inline Bytes encoded_again(const wire::Record& record) {
  return std::visit(
      [](const auto& held) {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
          return Bytes{};
        else
          return encoded(held);
      },
      record);
}

inline void note(Transcript& transcript, wire::DecodeEvent event, const wire::Decoder& decoder) {
  if (event == wire::DecodeEvent::kNothing) return;
  transcript.events.push_back(event);
  transcript.records.push_back(encoded_again(decoder.record()));
}

inline Transcript decoded_by_bytes(std::span<const std::uint8_t> stream) {
  Transcript transcript;
  wire::Decoder decoder;
  for (const std::uint8_t byte : stream) note(transcript, decoder.push(byte), decoder);
  transcript.corrupt = decoder.corrupt();
  transcript.cut = decoder.is_inside_record();
  return transcript;
}

/// As decoded_by_bytes(), in spans of at most `chunk` bytes.
inline Transcript decoded_by_spans(std::span<const std::uint8_t> stream, std::size_t chunk) {
  Transcript transcript;
  wire::Decoder decoder;
  while (!stream.empty()) {
    auto part = stream.first(std::min(chunk, stream.size()));
    stream = stream.subspan(part.size());
    while (!part.empty()) note(transcript, decoder.next(part), decoder);
  }
  transcript.corrupt = decoder.corrupt();
  transcript.cut = decoder.is_inside_record();
  return transcript;
}

/// `bytes` as one whole decoded record of type T; default-constructed where it is none.
template <class T>
T decoded_as(std::span<const std::uint8_t> bytes) {
  wire::Decoder decoder;
  if (decoder.next(bytes) != wire::DecodeEvent::kRecord) return T{};
  const T* record = std::get_if<T>(&decoder.record());
  return record == nullptr ? T{} : *record;
}

/// Type, payload and a right check sum, stuffed: what a sender with another idea of a record would send.
inline Bytes sealed(std::uint8_t type, std::span<const std::uint8_t> payload) {
  Bytes plain{type};
  plain.insert(plain.end(), payload.begin(), payload.end());
  std::array<std::uint8_t, wire::kCrcSize> crc{};
  wire::store_little_endian(crc.data(), wire::crc32(plain));
  plain.insert(plain.end(), crc.begin(), crc.end());
  Bytes stuffed(wire::cobs_encoded_bound(plain.size()) + 1);
  stuffed.resize(wire::cobs_encode(plain, stuffed) + 1);
  stuffed.back() = wire::kDelimiter;
  return stuffed;
}

inline void append(Bytes& stream, std::span<const std::uint8_t> bytes) {
  stream.insert(stream.end(), bytes.begin(), bytes.end());
}

inline Bytes random_record(Random& random) {
  switch (random() % 6) {
    case 0:
      return encoded(reference_configuration());
    case 1:
      return encoded(Health{.sequence = static_cast<std::uint32_t>(random())});
    case 2:
      return encoded(wire::End{static_cast<std::uint32_t>(random())});
    default:
      return encoded(random_frame(random));
  }
}

/// Records with bytes changed, lost and added, and garbage between them.
inline Bytes random_stream(Random& random, std::size_t records) {
  Bytes stream;
  for (std::size_t k = 0; k < records; ++k) {
    Bytes bytes = random_record(random);
    const auto at = static_cast<std::ptrdiff_t>(random() % bytes.size());
    switch (random() % 8) {
      case 0:
        bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1U << random() % 8);
        break;
      case 1:
        bytes.erase(bytes.begin() + at);
        break;
      case 2:
        bytes.insert(bytes.begin() + at, static_cast<std::uint8_t>(random()));
        break;
      case 3:
        bytes.resize(static_cast<std::size_t>(at));
        break;
      case 4:
        append(stream, Bytes(random() % 40, static_cast<std::uint8_t>(random() % 2 == 0 ? 0 : random())));
        break;
      default:
        break;
    }
    append(stream, bytes);
  }
  return stream;
}

}  // namespace morepro::wire_test
