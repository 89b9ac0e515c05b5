#pragma once
#include "lib/wire/field_list.hpp"
#include "lib/wire/record.hpp"

namespace morepro::wire {

template <>
inline constexpr auto kFields<Ready> =
    std::tuple{&Ready::protocol_version, &Ready::build_id, &Ready::reset_cause};

template <>
inline constexpr auto kFields<End> = std::tuple{&End::frames};

inline void write_payload(ByteWriter& writer, const Ready& ready) { write_fields(writer, ready); }
inline void read_payload(ByteReader& reader, Ready& ready) { read_fields(reader, ready); }

inline void write_payload(ByteWriter& writer, const End& end) { write_fields(writer, end); }
inline void read_payload(ByteReader& reader, End& end) { read_fields(reader, end); }

inline void write_payload(ByteWriter& writer, const Text& text) {
  if (text.size > Text::kMaxSize) return writer.reject();
  for (const char c : text.view()) writer.put(static_cast<std::uint8_t>(c));
}

inline void read_payload(ByteReader& reader, Text& text) {
  if (reader.remaining() > Text::kMaxSize) return;
  const auto bytes = reader.take(reader.remaining());
  if (!text.assign({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) reader.reject();
}

}  // namespace morepro::wire
