#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

using wire::DecodeEvent;

TEST(WireDecoder, SpansOfAnySizeGiveTheSameAsSingleBytes) {
  Random random(12);
  for (int round = 0; round < 200; ++round) {
    const Bytes stream = random_stream(random, 40);
    const Transcript expected = decoded_by_bytes(stream);
    for (const std::size_t chunk :
         {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{64}, std::size_t{1000}, stream.size()})
      ASSERT_EQ(decoded_by_spans(stream, chunk), expected) << "round " << round << ", chunks of " << chunk;
  }
}

TEST(WireDecoder, FindsEverySingleBitErrorOfAFrame) {
  Random random(13);
  for (int round = 0; round < 50; ++round) {
    const Bytes good = encoded(random_frame(random));
    for (std::size_t bit = 0; bit < 8 * (good.size() - 1); ++bit) {
      Bytes bad = good;
      bad[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      const auto transcript = decoded_by_bytes(bad);
      ASSERT_GE(transcript.corrupt.total(), 1U) << "bit " << bit;
      for (const auto event : transcript.events) ASSERT_EQ(event, DecodeEvent::kCorrupt) << "bit " << bit;
    }
  }
}

TEST(WireDecoder, AnErrorInADelimiterCostsTheTwoRecordsThatItParted) {
  const Bytes frame = encoded(SensorFrame{.sequence = 1});
  for (unsigned bit = 0; bit < 8; ++bit) {
    Bytes stream = frame;
    append(stream, frame);
    stream[frame.size() - 1] ^= static_cast<std::uint8_t>(1U << bit);
    append(stream, encoded(SensorFrame{.sequence = 2}));
    const auto transcript = decoded_by_bytes(stream);
    ASSERT_EQ(transcript.events, (std::vector{DecodeEvent::kCorrupt, DecodeEvent::kRecord}));
    EXPECT_EQ(transcript.records.back(), encoded(SensorFrame{.sequence = 2}));
  }
}

TEST(WireDecoder, ARecordThatIsCutAtAnyByteIsNoRecord) {
  Random random(14);
  const Bytes whole = encoded(random_frame(random));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto cut = std::span(whole).first(size);
    const auto open = decoded_by_bytes(cut);
    EXPECT_TRUE(open.events.empty()) << size;
    EXPECT_EQ(open.cut, size > 0) << size;
    Bytes closed(cut.begin(), cut.end());
    closed.push_back(wire::kDelimiter);
    if (size == 0 || size + 1 == whole.size()) continue;
    EXPECT_EQ(decoded_by_bytes(closed).events, std::vector{DecodeEvent::kCorrupt}) << size;
  }
}

TEST(WireDecoder, LosesAtMostOneRecordAfterGarbage) {
  Random random(15);
  const Bytes first = encoded(SensorFrame{.sequence = 1});
  const Bytes second = encoded(SensorFrame{.sequence = 2});
  for (int round = 0; round < 5000; ++round) {
    Bytes stream(random() % 2000);
    for (auto& byte : stream) byte = static_cast<std::uint8_t>(random());
    append(stream, first);
    append(stream, second);
    const auto transcript = decoded_by_bytes(stream);
    ASSERT_FALSE(transcript.records.empty());
    ASSERT_EQ(transcript.records.back(), second);
  }
}

TEST(WireDecoder, LosesNothingBehindADelimiter) {
  Bytes stream{1, 2, 3, 0};
  append(stream, encoded(SensorFrame{.sequence = 1}));
  EXPECT_EQ(decoded_by_bytes(stream).events, (std::vector{DecodeEvent::kCorrupt, DecodeEvent::kRecord}));
}

TEST(WireDecoder, ZerosBetweenRecordsMeanNothing) {
  Bytes stream(100000, 0);
  append(stream, encoded(SensorFrame{.sequence = 1}));
  stream.resize(stream.size() + 100000, 0);
  for (const auto& transcript : {decoded_by_bytes(stream), decoded_by_spans(stream, stream.size())}) {
    EXPECT_EQ(transcript.events, std::vector{DecodeEvent::kRecord});
    EXPECT_EQ(transcript.corrupt.total(), 0U);
  }
}

TEST(WireDecoder, AnEndlessRecordIsOneOfWrongLengthAndTheNextOneIsRead) {
  Bytes stream(1000000, 0xFF);
  stream.push_back(wire::kDelimiter);
  append(stream, encoded(SensorFrame{.sequence = 1}));
  for (const auto& transcript :
       {decoded_by_bytes(stream), decoded_by_spans(stream, 4096), decoded_by_spans(stream, stream.size())}) {
    EXPECT_EQ(transcript.events, (std::vector{DecodeEvent::kCorrupt, DecodeEvent::kRecord}));
    EXPECT_EQ(transcript.corrupt, (wire::CorruptCounts{.length = 1}));
  }
}

TEST(WireDecoder, LeavesTheRestOfTheSpanToItsCaller) {
  Bytes stream = encoded(SensorFrame{.sequence = 1});
  const std::size_t size = stream.size();
  append(stream, encoded(SensorFrame{.sequence = 2}));
  wire::Decoder decoder;
  std::span<const std::uint8_t> rest(stream);
  EXPECT_EQ(decoder.next(rest), DecodeEvent::kRecord);
  EXPECT_EQ(rest.size(), stream.size() - size);
  EXPECT_EQ(decoder.next(rest), DecodeEvent::kRecord);
  EXPECT_TRUE(rest.empty());
  EXPECT_EQ(decoder.next(rest), DecodeEvent::kNothing);
}

}  // namespace
}  // namespace morepro::wire_test
