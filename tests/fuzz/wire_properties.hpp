#pragma once
#include <cstdio>
#include <cstdlib>
#include <span>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {

inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", property);
  std::abort();
}

inline Bytes decoded_and_encoded_again(std::span<const std::uint8_t> bytes) {
  wire::Decoder decoder;
  require(decoder.next(bytes) == wire::DecodeEvent::kRecord, "what encode() gives can be decoded");
  return encoded_again(decoder.record());
}

/// What holds for any bytes from the link.
inline void check_stream(std::span<const std::uint8_t> stream, std::size_t chunk) {
  const Transcript transcript = decoded_by_bytes(stream);
  require(decoded_by_spans(stream, chunk) == transcript, "spans give the same as single bytes");
  for (const Bytes& record : transcript.records)
    if (!record.empty())
      require(decoded_and_encoded_again(record) == record, "decode, encode, decode is decode");
}

/// As check_stream() behind an intact envelope, which random bytes never have: `bytes` are type and payload.
inline void check_sealed(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  const Bytes record = sealed(bytes.front(), bytes.subspan(1));
  check_stream(record, record.size());
}

}  // namespace morepro::wire_test
