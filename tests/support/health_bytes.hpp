#pragma once
#include <cstdint>
#include <vector>

#include "lib/wire/record_codec.hpp"

namespace morepro::test {

inline std::vector<std::uint8_t> bytes_of(const Health& health) {
  std::vector<std::uint8_t> bytes(wire::kHealthPayload);
  wire::ByteWriter writer(bytes);
  wire::write_payload(writer, health);
  return bytes;
}

}  // namespace morepro::test
