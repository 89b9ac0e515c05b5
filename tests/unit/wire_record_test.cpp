#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

using wire::DecodeEvent;
using wire::Record;
using wire::RecordFault;

/// Payload of type T from random bytes: every field holds whatever bits allow a decoding.
template <class T>
Bytes random_record_of(Random& random, std::size_t payload_size) {
  while (true) {
    Bytes payload(payload_size);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() % 6 == 0 ? random() : random() % 2);
    if constexpr (std::is_same_v<T, MonitorConfiguration>) payload[0] = wire::kConfigurationLayout;
    const auto bytes = sealed(static_cast<std::uint8_t>(wire::LayoutOf<T>::kType), payload);
    wire::Decoder decoder;
    std::span<const std::uint8_t> rest(bytes);
    if (decoder.next(rest) == DecodeEvent::kRecord) return bytes;
  }
}

TEST(WireRecord, FramesComeBackBitForBit) {
  Random random(6);
  for (int round = 0; round < 20000; ++round) {
    const SensorFrame frame = random_frame(random);
    const auto back = decoded_as<SensorFrame>(encoded(frame));
    ASSERT_EQ(back.sequence, frame.sequence);
    ASSERT_EQ(back.time_us, frame.time_us);
    ASSERT_EQ(back.present, frame.present);
    for (std::size_t k = 0; k < kChannelCount; ++k)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(back.value[k]), std::bit_cast<std::uint32_t>(frame.value[k]));
  }
}

TEST(WireRecord, AChannelThatIsNotPresentIsNotSentAndComesBackAsZero) {
  SensorFrame frame;
  frame.set(Channel::kSpindleSpeed, 5.0F);
  const auto size = encoded(frame).size();
  frame.value[index_of(Channel::kFeedSpeed)] = 7.0F;
  EXPECT_EQ(encoded(frame).size(), size);
  EXPECT_EQ(decoded_as<SensorFrame>(encoded(frame)).get(Channel::kFeedSpeed), 0.0F);
}

template <class T>
void expect_round_trip(unsigned seed, std::size_t payload_size) {
  Random random(seed);
  for (int round = 0; round < 300; ++round) {
    const T record = decoded_as<T>(random_record_of<T>(random, payload_size));
    ASSERT_TRUE(same(decoded_as<T>(encoded(record)), record));
  }
}

TEST(WireRecord, HealthComesBack) { expect_round_trip<Health>(7, wire::kHealthPayload); }
TEST(WireRecord, ConfigurationComesBack) {
  expect_round_trip<MonitorConfiguration>(8, wire::kConfigurationPayload);
}
TEST(WireRecord, ReadyComesBack) { expect_round_trip<wire::Ready>(9, 6); }
TEST(WireRecord, EndComesBack) { expect_round_trip<wire::End>(10, 4); }

TEST(WireRecord, ConfigurationKeepsEveryField) {
  EXPECT_FALSE(same(thesis_configuration(), reference_configuration()));
  const auto back = decoded_as<MonitorConfiguration>(encoded(thesis_configuration()));
  EXPECT_EQ(back.machine.spindle.inductance_h, thesis_machine().spindle.inductance_h);
  EXPECT_EQ(back.machine.contact.form, ContactForm::kThesis);
  EXPECT_EQ(back.sensors[Channel::kSpindleAcceleration].noise, 1000.0);
  EXPECT_EQ(back.grid.count, 11U);
  EXPECT_EQ(back.tuning.chip_load_drift_mm, thesis_configuration().tuning.chip_load_drift_mm);
}

TEST(WireRecord, TextHoldsUpTo200BytesWithoutControlCharacters) {
  wire::Text text;
  EXPECT_TRUE(text.assign(std::string(wire::Text::kMaxSize, 'x')));
  EXPECT_EQ(decoded_as<wire::Text>(encoded(text)).view(), text.view());
  EXPECT_FALSE(text.assign(std::string(wire::Text::kMaxSize + 1, 'x')));
  EXPECT_FALSE(text.assign("two\nlines"));
  EXPECT_EQ(text.view().size(), wire::Text::kMaxSize) << "a refused text changes nothing";
  EXPECT_TRUE(text.assign("Vorschub: 12 µm"));
  EXPECT_EQ(decoded_as<wire::Text>(encoded(text)).view(), "Vorschub: 12 µm");
}

TEST(WireRecord, EveryNanOfAHealthIsSentAsTheSameOne) {
  Health one;
  Health other;
  one.chip_load_mm = std::bit_cast<float>(0xff812345U);
  other.chip_load_mm = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encoded(one), encoded(other));
}

template <class T>
void expect_exact_room(const T& record) {
  const Bytes whole = encoded(record);
  for (std::size_t room = 0; room < whole.size(); ++room) {
    Bytes out(whole.size() + 1, 0xA5);
    EXPECT_EQ(wire::encode(record, std::span(out).first(room)), 0U) << room;
    EXPECT_EQ(out[room], 0xA5) << "written beyond the buffer of " << room;
  }
  Bytes out(whole.size());
  EXPECT_EQ(wire::encode(record, out), whole.size());
}

TEST(WireRecord, DoesNotFitIntoABufferThatIsTooSmall) {
  Random random(11);
  expect_exact_room(random_frame(random));
  expect_exact_room(Health{});
  expect_exact_room(reference_configuration());
  expect_exact_room(wire::Ready{});
}

TEST(WireRecord, AFrameWithAnUnknownChannelIsNotSent) {
  SensorFrame frame;
  frame.present = 1U << kChannelCount;
  Bytes out(100);
  EXPECT_EQ(wire::encode(frame, out), 0U);
}

RecordFault fault_of(const Bytes& bytes) {
  wire::Decoder decoder;
  std::span<const std::uint8_t> rest(bytes);
  if (decoder.next(rest) == DecodeEvent::kRecord) return RecordFault::kNone;
  EXPECT_TRUE(std::holds_alternative<std::monostate>(decoder.record()));
  const auto& counts = decoder.corrupt();
  if (counts.cobs == 1) return RecordFault::kCobs;
  if (counts.length == 1) return RecordFault::kLength;
  if (counts.crc == 1) return RecordFault::kCrc;
  return counts.unknown_type == 1 ? RecordFault::kUnknownType : RecordFault::kContent;
}

struct BadRecord {
  const char* what;
  std::uint8_t type;
  Bytes payload;
  RecordFault fault;
};

/// Of the gap's fields in a health's payload: they are the last.
constexpr std::size_t kGapAt = wire::kHealthPayload - wire::wire_size<gap::GapFinding>();

TEST(WireRecord, AnIntactRecordThatMeansNothingIsRefusedByItsCause) {
  Bytes bad_state(wire::kHealthPayload);
  bad_state[8] = 0xFF;
  Bytes bad_status(wire::kHealthPayload);
  bad_status[kGapAt - 2] = 0xFF;
  Bytes bad_partner(wire::kHealthPayload);
  bad_partner[kGapAt - 1] = index_of(Parameter::kBackEmfConstant) + 2;
  const auto bad_gap = [](std::size_t offset, std::uint8_t value) {
    Bytes bytes(wire::kHealthPayload);
    bytes[kGapAt + offset] = value;
    return bytes;
  };
  Bytes bad_layout(wire::kConfigurationPayload);
  bad_layout[0] = wire::kConfigurationLayout + 1;
  const std::vector<BadRecord> records{
      {"no type", 0, {}, RecordFault::kUnknownType},
      {"a type of a later version", 7, {1, 2, 3}, RecordFault::kUnknownType},
      {"an empty frame", 1, {}, RecordFault::kLength},
      {"a frame that announces a value and has none",
       1,
       {0, 0, 0, 0, 0, 0, 0, 0, 1, 0},
       RecordFault::kLength},
      {"a frame with more values than it announces", 1, Bytes(14), RecordFault::kLength},
      {"a frame with channel 14", 1, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0x40, 1, 2, 3, 4}, RecordFault::kContent},
      {"a health that is too short", 2, Bytes(wire::kHealthPayload - 1), RecordFault::kLength},
      {"a health that is too long", 2, Bytes(wire::kHealthPayload + 1), RecordFault::kLength},
      {"a health in no known state", 2, bad_state, RecordFault::kContent},
      {"a parameter in no known status", 2, bad_status, RecordFault::kContent},
      {"a parameter with a partner that does not exist", 2, bad_partner, RecordFault::kContent},
      {"a gap of no known verdict", 2, bad_gap(0, 6), RecordFault::kContent},
      {"a gap in no known place", 2, bad_gap(1, 5), RecordFault::kContent},
      {"a gap by an effect without a name", 2, bad_gap(2, gap::kEffectCount), RecordFault::kContent},
      {"a gap with more aliases than there is room", 2, bad_gap(3, 3), RecordFault::kContent},
      {"a gap with an alias without a name", 2, bad_gap(5, gap::kEffectCount), RecordFault::kContent},
      {"a configuration of another layout", 3, bad_layout, RecordFault::kContent},
      {"a text that is too long", 6, Bytes(wire::Text::kMaxSize + 1, 'x'), RecordFault::kLength},
      {"a text with a line break", 6, {'a', '\n', 'b'}, RecordFault::kContent},
      {"more than any record has", 3, Bytes(wire::kLargestRecord), RecordFault::kLength},
  };
  for (const auto& bad : records) EXPECT_EQ(fault_of(sealed(bad.type, bad.payload)), bad.fault) << bad.what;
}

}  // namespace
}  // namespace morepro::wire_test
