#include "sim_host/recording/csv_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "sim_host/recording/csv_writer.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

class Csv : public testing::Test {
 protected:
  Csv()
      : path_(testing::TempDir() + "csv_" + testing::UnitTest::GetInstance()->current_test_info()->name() +
              ".csv") {}
  ~Csv() override { std::filesystem::remove(path_); }

  void write(const std::string& text) { std::ofstream(path_, std::ios::binary) << text; }

  std::vector<SensorFrame> read() {
    CsvReader reader(path_);
    std::vector<SensorFrame> frames;
    for (SensorFrame frame; reader.next(frame);) frames.push_back(frame);
    info_ = reader.info();
    tally_ = reader.tally();
    return frames;
  }

  std::string path_;
  RecordingInfo info_;
  RecordingTally tally_;
};

TEST_F(Csv, TakesColumnsInAnyOrderWithMetadataAndWindowsLineEnds) {
  write(
      "\xEF\xBB\xBF# machine: thesis\r\n# note\r\ncontact, time_s ,armature_voltage_v\r\n1,0.0, "
      "48.5\r\n0,0.001,-2e1\r\n");
  const auto frames = read();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].get(Channel::kContact), 1.0F);
  EXPECT_EQ(frames[0].get(Channel::kArmatureVoltage), 48.5F);
  EXPECT_EQ(frames[1].get(Channel::kArmatureVoltage), -20.0F);
  EXPECT_EQ(info_.metadata_value("machine"), "thesis");
  EXPECT_EQ(info_.recorded, bit_of(Channel::kContact) | bit_of(Channel::kArmatureVoltage));
}

TEST_F(Csv, TakesEmptyFieldsAndNanAsMissingSamplesButKeepsInfinity) {
  write("time_s,contact,spindle_speed_rad_s\n0,,nan\n1e-3,1,inf\n2e-3, ,NaN\n");
  const auto frames = read();
  EXPECT_EQ(frames[0].present, 0);
  EXPECT_TRUE(frames[1].has(Channel::kSpindleSpeed));
  EXPECT_TRUE(std::isinf(frames[1].get(Channel::kSpindleSpeed)));
  EXPECT_EQ(frames[2].present, 0);
}

TEST_F(Csv, CountsMissingRowsInSequenceNumbersAndTally) {
  write("time_s,contact\n0,1\n0.001,1\n0.002,1\n0.005,1\n0.006,1\n0.009,1\n0.010,1\n");
  const auto frames = read();
  EXPECT_EQ(frames[3].sequence, 5U);
  EXPECT_EQ(frames.back().sequence, 10U);
  EXPECT_EQ(tally_.missing_rows, 4U);
  EXPECT_EQ(tally_.gaps, 2U);
  EXPECT_DOUBLE_EQ(tally_.first_gap_s, 0.002);
}

TEST_F(Csv, InfersTheRateThatRoundedTimesHide) {
  std::string text = "time_s,contact\n";
  for (int k = 0; k < 300; ++k) text += std::to_string(k / 3000.0) + ",1\n";
  write(text);
  (void)read();
  EXPECT_DOUBLE_EQ(info_.rate_hz, 3000.0);
}

std::string rows_at(const std::vector<double>& times_s, const std::string& metadata = "") {
  std::ostringstream text;
  text << metadata << "time_s,contact\n" << std::fixed << std::setprecision(6);
  for (const double time_s : times_s) text << time_s << ",1\n";
  return text.str();
}

TEST_F(Csv, CountsRowsThatWereDroppedRegularlyByTheStatedRate) {
  std::vector<double> times_s;
  for (int k = 0; k < 1000; ++k) times_s.push_back(2e-4 * k);
  write(rows_at(times_s, "# rate_hz: 10000\n"));
  const auto frames = read();
  EXPECT_EQ(info_.rate_hz, 10000.0);
  EXPECT_EQ(frames.back().sequence, 1998U);
  EXPECT_EQ(tally_.missing_rows, 999U);
  EXPECT_TRUE(info_.warnings.empty());
}

TEST_F(Csv, CountsHalfOfTheRowsDroppedAtRandomByTheStatedRate) {
  std::mt19937 random(1);
  std::vector<double> times_s{0.0};
  for (int k = 1; k < 20000; ++k) {
    if (random() % 2 == 0 || k == 19999) times_s.push_back(1e-4 * k);
  }
  write(rows_at(times_s, "# rate_hz: 10000\n"));
  EXPECT_EQ(read().back().sequence, 19999U);
  EXPECT_EQ(tally_.missing_rows, 20000U - times_s.size());
}

TEST_F(Csv, WarnsOfAStatedRateThatTheTimesContradictAndTakesTheTimes) {
  for (const char* rate : {"1000", "14000", "fast", "-1"}) {
    write(rows_at({0.0, 1e-4, 2e-4, 3e-4}, std::string("# rate_hz: ") + rate + "\n"));
    EXPECT_EQ(read().back().sequence, 3U) << rate;
    EXPECT_EQ(info_.rate_hz, 10000.0) << rate;
    ASSERT_EQ(info_.warnings.size(), 1U) << rate;
    EXPECT_NE(info_.warnings[0].find(rate), std::string::npos);
  }
}

TEST_F(Csv, TakesJitterOfNearlyHalfAStepForNoMissingRow) {
  for (const char* metadata : {"", "# rate_hz: 10000\n"}) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> jitter_s(-4e-5, 4e-5);
    std::vector<double> times_s;
    for (int k = 0; k < 30000; ++k) times_s.push_back(1e-4 * (k + 1) + jitter_s(random));
    write(rows_at(times_s, metadata));
    EXPECT_EQ(read().back().sequence, 29999U);
    EXPECT_EQ(tally_.missing_rows, 0U);
    // Five digits: half of the last one, and the jitter over the longest lag.
    EXPECT_NEAR(info_.rate_hz, 10000.0, 1.0);
  }
}

TEST_F(Csv, MeasuresARateThatIsStatedNearly) {
  for (const char* rate : {"9000", "9900", "10100", "11500"}) {
    std::vector<double> times_s;
    for (int k = 0; k < 5000; ++k) times_s.push_back(1e-4 * k);
    write(rows_at(times_s, std::string("# rate_hz: ") + rate + "\n"));
    EXPECT_EQ(read().back().sequence, 4999U) << rate;
    EXPECT_DOUBLE_EQ(info_.rate_hz, 10000.0) << rate;
  }
}

TEST_F(Csv, FollowsARateThatFiveDigitsDoNotHold) {
  std::vector<double> times_s;
  for (int k = 0; k < 200000; ++k) times_s.push_back(k / 7777.749);
  write(rows_at(times_s));
  EXPECT_EQ(read().back().sequence, 199999U);
}

TEST_F(Csv, WrapsMicrosecondsAfterSeventyOneMinutes) {
  write("time_s,contact\n4294.967295,1\n4294.967296,1\n4294.967297,1\n");
  const auto frames = read();
  EXPECT_EQ(frames[0].time_us, 0xFFFFFFFFU);
  EXPECT_EQ(frames[1].time_us, 0U);
}

TEST_F(Csv, NamesLineAndColumnOfTextInANumber) {
  write("time_s,contact\n0,1\n0.001,1\n0.002,open\n");
  try {
    (void)read();
    FAIL() << "text was taken as a number";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("line 4, column 7"), std::string::npos) << error.what();
  }
}

TEST_F(Csv, GivesBackEveryBitThatWasWritten) {
  std::vector<SensorFrame> written(3);
  for (std::uint32_t k = 0; k < written.size(); ++k) {
    written[k].sequence = k;
    written[k].time_us = 0xFFFFFF00U + 100 * k;
    written[k].set(Channel::kSpindleSpeed, std::nextafter(577.7F, 600.0F * static_cast<float>(k)));
    if (k != 1) written[k].set(Channel::kArmatureCurrent, 1.0e-38F / static_cast<float>(k + 3));
  }
  {
    OutputFile file(path_);
    CsvWriter writer(file, {{"machine", "reference"}},
                     bit_of(Channel::kSpindleSpeed) | bit_of(Channel::kArmatureCurrent), 0xFFFFFF00);
    for (const SensorFrame& frame : written) EXPECT_TRUE(writer.write(frame));
    EXPECT_FALSE(writer.write(written.back())) << "a repeated time was written";
    file.commit();
  }
  const auto read_back = read();
  ASSERT_EQ(read_back.size(), written.size());
  for (std::size_t k = 0; k < written.size(); ++k) {
    EXPECT_EQ(read_back[k].time_us, written[k].time_us);
    EXPECT_EQ(read_back[k].present, written[k].present);
    EXPECT_EQ(read_back[k].get(Channel::kSpindleSpeed), written[k].get(Channel::kSpindleSpeed));
    EXPECT_EQ(read_back[k].get(Channel::kArmatureCurrent), written[k].get(Channel::kArmatureCurrent));
  }
}

TEST_F(Csv, LeavesNothingBehindWithoutACommit) {
  { OutputFile(path_).write(std::string_view("half")); }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace morepro::host
