#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/wire_properties.hpp"

/// libFuzzer: the bytes as they come from the link, and as a record with a right check sum.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  morepro::wire_test::check_stream(bytes, 1 + size / 3);
  morepro::wire_test::check_sealed(bytes);
  return 0;
}
