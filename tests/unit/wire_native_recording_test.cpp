#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "sim_host/recording/native_reader.hpp"
#include "sim_host/recording/native_writer.hpp"
#include "sim_host/support/user_error.hpp"
#include "tests/unit/wire_support.hpp"

namespace morepro::wire_test {
namespace {

using host::NativeReader;
using host::NativeWriter;
using host::OutputFile;

class WireNativeRecording : public testing::Test {
 protected:
  WireNativeRecording() {
    std::string name = (std::filesystem::temp_directory_path() / "morepro-recording-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~WireNativeRecording() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  [[nodiscard]] Bytes bytes_of(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void put(const std::string& name, std::span<const std::uint8_t> bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  [[nodiscard]] static SensorFrame frame(std::uint32_t sequence) {
    SensorFrame made{.sequence = sequence, .time_us = 333U * sequence + sequence / 3U};
    made.set(Channel::kSpindleSpeed, static_cast<float>(sequence));
    if (sequence > 5) made.set(Channel::kContact, 1.0F);
    return made;
  }

  void write_recording(const std::string& name, std::uint32_t frames) const {
    OutputFile file(path(name));
    NativeWriter writer(file, {{"machine", "thesis"}, {"note", "a: b"}});
    writer.write(thesis_configuration());
    for (std::uint32_t k = 0; k < frames; ++k) writer.write(frame(k));
    writer.finish();
    file.commit();
  }

  [[nodiscard]] static std::vector<SensorFrame> frames_of(NativeReader& reader) {
    std::vector<SensorFrame> frames;
    for (SensorFrame read; reader.next(read);) frames.push_back(read);
    return frames;
  }

  [[nodiscard]] std::string refusal_of(const std::string& name) const {
    try {
      const NativeReader reader(path(name));
    } catch (const host::UserError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(WireNativeRecording, GivesBackEverythingThatWasWritten) {
  write_recording("run.mrec", 100);
  NativeReader reader(path("run.mrec"));
  const auto frames = frames_of(reader);
  ASSERT_EQ(frames.size(), 100U);
  for (std::uint32_t k = 0; k < 100; ++k) EXPECT_TRUE(same(frames[k], frame(k)));
  EXPECT_TRUE(reader.integrity().is_complete());
  EXPECT_TRUE(reader.info().warnings.empty());
  EXPECT_EQ(reader.info().metadata_value("machine"), "thesis");
  EXPECT_EQ(reader.info().metadata_value("note"), "a: b");
  ASSERT_TRUE(reader.configuration().has_value());
  EXPECT_TRUE(same(*reader.configuration(), thesis_configuration()));
}

TEST_F(WireNativeRecording, SaysBeforehandWhichChannelsItHoldsAndAtWhichRate) {
  write_recording("run.mrec", 100);
  const NativeReader reader(path("run.mrec"));
  EXPECT_EQ(reader.info().recorded, bit_of(Channel::kSpindleSpeed) | bit_of(Channel::kContact));
  // Times are whole microseconds: over 99 steps the mean is right to 1 us in 33 ms.
  EXPECT_NEAR(reader.info().rate_hz, 3000.0, 3000.0 / 33000.0);
}

TEST_F(WireNativeRecording, IsReadableUpToACutAtAnyByteAndSaysSo) {
  write_recording("run.mrec", 20);
  const Bytes whole = bytes_of("run.mrec");
  NativeReader complete(path("run.mrec"));
  std::size_t readable = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put("cut.mrec", std::span(whole).first(size));
    const auto expected = decoded_by_bytes(std::span(whole).first(size));
    if (expected.events.empty()) {
      EXPECT_NE(refusal_of("cut.mrec"), "") << size;
      continue;
    }
    NativeReader reader(path("cut.mrec"));
    const auto frames = frames_of(reader);
    ASSERT_GE(frames.size(), readable) << size;
    readable = frames.size();
    for (std::uint32_t k = 0; k < frames.size(); ++k) ASSERT_TRUE(same(frames[k], frame(k)));
    ASSERT_FALSE(reader.integrity().is_complete()) << size;
    ASSERT_EQ(reader.info().warnings.size(), 1U) << size;
    ASSERT_LE(reader.integrity().cut_offset, size);
  }
  EXPECT_EQ(readable, 20U);
}

TEST_F(WireNativeRecording, SkipsADamagedRecordAndSaysWhere) {
  write_recording("run.mrec", 20);
  Bytes bytes = bytes_of("run.mrec");
  const std::size_t end_size = encoded(wire::End{20}).size();
  const std::size_t last_size = encoded(frame(19)).size();
  const std::size_t offset = bytes.size() - end_size - last_size;
  bytes[offset + 3] ^= 0x10;
  put("run.mrec", bytes);
  NativeReader reader(path("run.mrec"));
  EXPECT_EQ(frames_of(reader).size(), 19U);
  EXPECT_EQ(reader.integrity().corrupt.total(), 1U);
  EXPECT_EQ(reader.integrity().first_corrupt_offset, offset);
  EXPECT_TRUE(reader.integrity().has_end);
  EXPECT_FALSE(reader.integrity().is_complete());
  EXPECT_NE(reader.info().warnings.at(0).find("byte " + std::to_string(offset)), std::string::npos);
}

TEST_F(WireNativeRecording, ARecordBehindTheEndMakesItUnfinishedAgain) {
  write_recording("run.mrec", 3);
  Bytes bytes = bytes_of("run.mrec");
  append(bytes, encoded(frame(3)));
  put("run.mrec", bytes);
  EXPECT_FALSE(NativeReader(path("run.mrec")).integrity().has_end);
}

TEST_F(WireNativeRecording, AnUnfinishedRecordBehindTheEndMakesItUnfinishedAgain) {
  write_recording("run.mrec", 3);
  Bytes bytes = bytes_of("run.mrec");
  bytes.push_back(7);
  put("run.mrec", bytes);
  EXPECT_FALSE(NativeReader(path("run.mrec")).integrity().has_end);
}

TEST_F(WireNativeRecording, GivesTheFirstOfSeveralConfigurations) {
  Bytes bytes = encoded(thesis_configuration());
  append(bytes, encoded(reference_configuration()));
  put("run.mrec", bytes);
  EXPECT_TRUE(same(NativeReader(path("run.mrec")).configuration().value(), thesis_configuration()));
}

TEST_F(WireNativeRecording, CountsMissingFramesBySequenceAndTimeThroughTheWrap) {
  Bytes bytes;
  for (const std::uint32_t sequence : {0xFFFFFFFEU, 0xFFFFFFFFU, 2U, 3U, 5U})
    append(bytes, encoded(SensorFrame{.sequence = sequence, .time_us = 100U * sequence}));
  put("run.mrec", bytes);
  NativeReader reader(path("run.mrec"));
  EXPECT_EQ(frames_of(reader).size(), 5U);
  EXPECT_EQ(reader.tally().missing_rows, 3U);
  EXPECT_EQ(reader.tally().gaps, 2U);
  EXPECT_DOUBLE_EQ(reader.tally().first_gap_s, 4294.967196) << "the time of the row, as of a CSV";
  EXPECT_DOUBLE_EQ(reader.tally().duration_s, 7.0e-4);
}

TEST_F(WireNativeRecording, RefusesWhatIsNoRecording) {
  put("empty.mrec", {});
  EXPECT_NE(refusal_of("empty.mrec").find("empty.mrec: no native recording: the file is empty"),
            std::string::npos);
  const std::string csv = "time_s,armature_voltage_v\n0,1\n0.1,2\n";
  put("text.mrec", {reinterpret_cast<const std::uint8_t*>(csv.data()), csv.size()});
  EXPECT_NE(refusal_of("text.mrec").find("no intact record"), std::string::npos);
}

TEST_F(WireNativeRecording, LeavesNothingUnderItsNameUntilItIsCommitted) {
  {
    OutputFile file(path("run.mrec"));
    NativeWriter writer(file, {});
    writer.write(frame(0));
    EXPECT_FALSE(std::filesystem::exists(path("run.mrec")));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "given up: nothing is left";
}

TEST_F(WireNativeRecording, RefusesMetadataAndFramesThatTheFormatCannotHold) {
  OutputFile file(path("run.mrec"));
  EXPECT_THROW(NativeWriter(file, {{"comment", std::string(200, 'x')}}), host::UserError);
  NativeWriter writer(file, {});
  EXPECT_THROW(writer.write(SensorFrame{.present = 0xFFFF}), host::UserError);
}

}  // namespace
}  // namespace morepro::wire_test
