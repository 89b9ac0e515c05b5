#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/wire_properties.hpp"

namespace morepro::wire_test {
namespace {

Bytes noise(Random& random, std::size_t size, std::uint32_t values) {
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % values);
  return bytes;
}

/// Type and payload of about the right length, so that every record is decoded as often as it is refused.
Bytes payload(Random& random) {
  const std::size_t lengths[] = {
      wire::kFrameHeaderSize, wire::kHealthPayload, wire::kConfigurationPayload, 6, 4, 40};
  const std::size_t kind = random() % 6;
  Bytes bytes =
      noise(random, 1 + lengths[kind] + (random() % 8 == 0 ? random() % 60 : 0), random() % 2 == 0 ? 256 : 3);
  bytes[0] = static_cast<std::uint8_t>(kind + 1);
  if (kind == 2 && random() % 4 != 0) bytes[1] = wire::kConfigurationLayout;
  return bytes;
}

/// One round of the fuzzer; returns the number of bytes that went through the decoder.
std::size_t check_round(std::uint32_t seed) {
  Random random(seed);
  const Bytes stream = random() % 4 == 0 ? noise(random, random() % 3000, random() % 2 == 0 ? 256 : 5)
                                         : random_stream(random, 1 + random() % 40);
  check_stream(stream, 1 + random() % 300);
  const Bytes record = payload(random);
  check_sealed(record);
  return stream.size() + record.size();
}

}  // namespace
}  // namespace morepro::wire_test

/// Argument: number of bytes, 10,000,000 unless told. Always the same bytes; a failure ends in abort() behind
/// the number of its round.
int main(int argc, char** argv) {
  const std::uint64_t wanted = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000'000;
  std::uint64_t bytes = 0;
  std::uint32_t round = 0;
  for (; bytes < wanted; ++round) {
    if (round % 1000 == 0) std::fprintf(stderr, "round %" PRIu32 "\n", round);
    bytes += morepro::wire_test::check_round(round);
  }
  std::printf("%" PRIu64 " bytes in %" PRIu32 " rounds: every property held\n", bytes, round);
  return 0;
}
