#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "lib/wire/crc32.hpp"
#include "sim_host/recording/intact_frame.hpp"
#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

using host::FrameCheck;
using host::IntactFrame;

struct Paths {
  std::size_t fast = 0;  ///< frames
  std::size_t slow = 0;
};

/// As decoded_by_spans(), with the fast path in front of the decoder.
Transcript decoded_with_fast_path(std::span<const std::uint8_t> rest, Paths& frames) {
  Transcript transcript;
  wire::Decoder decoder;
  IntactFrame fast;
  while (!rest.empty()) {
    if (fast.take(rest, FrameCheck::kCrc)) {
      SensorFrame frame;
      fast.read(frame);
      transcript.events.push_back(wire::DecodeEvent::kRecord);
      transcript.records.push_back(encoded(frame));
      ++frames.fast;
    } else {
      const auto event = decoder.next(rest);
      note(transcript, event, decoder);
      if (event == wire::DecodeEvent::kRecord && std::holds_alternative<SensorFrame>(decoder.record()))
        ++frames.slow;
    }
  }
  transcript.corrupt = decoder.corrupt();
  transcript.cut = decoder.is_inside_record();
  return transcript;
}

TEST(WireNativeIntactFrame, GivesWhatTheDecoderGivesOnDamagedStreams) {
  Random random(1);
  constexpr std::size_t kRuns = 300;
  Paths frames;
  for (std::size_t run = 0; run < kRuns; ++run) {
    const Bytes stream = random_stream(random, 100);
    ASSERT_EQ(decoded_with_fast_path(stream, frames), decoded_by_spans(stream, stream.size())) << run;
  }
  EXPECT_GT(frames.fast, 10 * kRuns);
  EXPECT_LE(frames.slow, 4 * kRuns) << "only those at the end of a stream, of at least 16 bytes each";
}

TEST(WireNativeIntactFrame, RefusesEveryChangedByte) {
  Random random(2);
  for (int run = 0; run < 20; ++run) {
    Bytes bytes = encoded(random_frame(random));
    const std::size_t size = bytes.size();
    bytes.resize(size + 200);
    for (std::size_t at = 0; at + 1 < size; ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        bytes[at] ^= static_cast<std::uint8_t>(1U << bit);
        std::span<const std::uint8_t> rest(bytes);
        EXPECT_FALSE(IntactFrame().take(rest, FrameCheck::kCrc)) << "byte " << at << ", bit " << bit;
        EXPECT_EQ(rest.size(), bytes.size());
        bytes[at] ^= static_cast<std::uint8_t>(1U << bit);
      }
    }
  }
}

TEST(WireNativeIntactFrame, RefusesWhatIsNoFrameBehindARightCheckSum) {
  const Bytes empty_frame(wire::kFrameHeaderSize, 0);
  Bytes with_unknown_channel = empty_frame;
  with_unknown_channel[9] = 0x40;
  with_unknown_channel.resize(wire::kFrameHeaderSize + 4);
  const Bytes too_long(wire::kFrameHeaderSize + 1, 0);
  for (const Bytes& payload : {with_unknown_channel, too_long, Bytes{}, Bytes(3, 7)}) {
    Bytes bytes = sealed(1, payload);
    bytes.resize(300);
    std::span<const std::uint8_t> rest(bytes);
    EXPECT_FALSE(IntactFrame().take(rest, FrameCheck::kCrc)) << payload.size();
  }
  for (const std::uint8_t type : {std::uint8_t{1}, std::uint8_t{2}}) {
    Bytes bytes = sealed(type, empty_frame);
    bytes.resize(300);
    std::span<const std::uint8_t> rest(bytes);
    EXPECT_EQ(IntactFrame().take(rest, FrameCheck::kCrc), type == 1);
  }
}

TEST(WireNativeIntactFrame, ItsCheckSumIsThatOfTheWire) {
  Random random(3);
  for (std::size_t size = 0; size <= host::kCrcLongest; ++size) {
    for (int run = 0; run < 20; ++run) {
      Bytes bytes(host::kCrcLead + size);
      for (std::size_t k = host::kCrcLead; k < bytes.size(); ++k)
        bytes[k] = static_cast<std::uint8_t>(random());
      const auto plain = std::span<const std::uint8_t>(bytes).subspan(host::kCrcLead);
      EXPECT_EQ(host::frame_crc32(bytes.data() + host::kCrcLead, size), wire::crc32<1>(plain)) << size;
    }
  }
}

}  // namespace
}  // namespace morepro::wire_test
