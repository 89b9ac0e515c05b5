#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim_host/report/base64.hpp"
#include "sim_host/report/innovation_statistics.hpp"
#include "sim_host/report/phase.hpp"
#include "sim_host/report/recording_trace.hpp"
#include "sim_host/report/series_table.hpp"

namespace morepro::host {
namespace {

TEST(ReportBase64, IsThatOfTheStandard) {
  const std::pair<std::string, std::string> cases[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}, {"\xff\xfe", "//4="}};
  for (const auto& [text, code] : cases)
    EXPECT_EQ(base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), code);
}

TEST(ReportSeries, RowsThatNeverBeganHaveNoSamples) {
  SeriesTable table(1.0e-3, 16);
  const std::size_t a = table.add("a", "A", "V");
  const std::size_t b = table.add("b", "B", "V");
  table.begin_row(2);
  table.set(a, 1.0);
  table.begin_row(5);
  table.set(a, 3.0);
  table.set(b, 2.0);
  table.finish(8);
  const std::vector<Bucket> buckets = table.pyramid(a).buckets();
  ASSERT_EQ(buckets.size(), 8U);
  for (const std::size_t i : {0U, 1U, 3U, 4U, 6U, 7U}) EXPECT_TRUE(buckets[i].is_empty()) << i;
  EXPECT_EQ(buckets[2].low, 1.0F);
  EXPECT_EQ(table.pyramid(b).rows(), table.pyramid(a).rows());
}

TEST(ReportSeries, StepsRoundOutwardsAndWhatHasNoSampleIsLeftOut) {
  SeriesTable table(1.0, 16);
  const std::size_t a = table.add("a", "A", "V");
  table.add("never", "Never", "V");
  for (std::uint64_t row = 0; row < 3; ++row) {
    table.begin_row(row);
    if (row != 1) table.set(a, row == 0 ? -1.0 : 2.0);
  }
  table.finish(3);
  const auto json = table.json();
  EXPECT_FALSE(json.contains("never"));
  EXPECT_EQ(json["a"]["low"], -1.0);
  EXPECT_EQ(json["a"]["high"], 2.0);
  // 0 and 0; 65535 and 65535; 65534 and 65534, little endian.
  EXPECT_EQ(json["a"]["data"], "AAAAAP/////+//7/");
}

TEST(ReportInnovations, WhiteOnesHaveAFlatSpectrumAndNoMemory) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  InnovationStatistics statistics;
  NisWindow nis;
  constexpr int kSegments = 60;
  for (std::size_t i = 0; i < kSegments * InnovationStatistics::kSegment; ++i) {
    const double value = normal(random);
    statistics.take(value);
    nis.take(value);
  }
  const auto spectrum = statistics.spectrum();
  double mean = 0.0;
  for (const double power : spectrum) mean += power / static_cast<double>(spectrum.size());
  EXPECT_NEAR(mean, 1.0, 0.02);  // four standard deviations of 60 x 1024 exponential variables
  const auto memory = statistics.autocorrelation();
  EXPECT_EQ(memory[0], 1.0);
  int outside = 0;
  for (std::size_t lag = 1; lag < memory.size(); ++lag)
    outside += std::fabs(memory[lag]) > statistics.bound();
  EXPECT_LE(outside, 9);  // 3 of 60 on average; more than 9 in one of 600 sequences
  EXPECT_NEAR(nis.value(), 1.0, 2.0 * NisWindow::bound());
}

TEST(ReportInnovations, ATonesLineIsInItsBinAndAHoleEndsASegment) {
  InnovationStatistics statistics;
  constexpr std::size_t kBin = 100;
  for (std::size_t i = 0; i < 2 * InnovationStatistics::kSegment; ++i)
    statistics.take(std::sin(2.0 * M_PI * kBin * static_cast<double>(i) / InnovationStatistics::kSegment));
  const auto spectrum = statistics.spectrum();
  EXPECT_EQ(std::max_element(spectrum.begin(), spectrum.end()) - spectrum.begin(), kBin);
  for (std::size_t i = 0; i + 1 < InnovationStatistics::kSegment; ++i) statistics.take(1.0);
  statistics.take(std::nan(""));
  statistics.take(1.0);
  EXPECT_EQ(statistics.segments(), 2U);
}

TEST(ReportPhase, ContactThenMotionThenRest) {
  PhaseWatch watch(reference_sensors());
  SensorFrame frame;
  frame.set(Channel::kSpindleSpeed, 2.0F);
  EXPECT_EQ(watch.step(frame), Phase::kIdle) << "within the sensor's noise";
  frame.set(Channel::kSpindleSpeed, -300.0F);
  EXPECT_EQ(watch.step(frame), Phase::kAirCut);
  frame.set(Channel::kContact, 1.0F);
  EXPECT_EQ(watch.step(frame), Phase::kCut);
  EXPECT_EQ(watch.step(SensorFrame{}), Phase::kCut) << "a missing sample leaves what was";
  EXPECT_FALSE(PhaseWatch::can_tell(bit_of(Channel::kArmatureVoltage)));
}

TEST(ReportPhase, RunsBeginWhereTheValueChanges) {
  Pyramid pyramid(16);
  for (const float value : {0.0F, 0.0F, 2.0F, 2.0F, 1.0F}) pyramid.take(value);
  pyramid.skip(2);
  EXPECT_EQ(runs_of(pyramid).dump(), "[[0,0],[2,2],[4,1],[5,null]]");
}

}  // namespace
}  // namespace morepro::host
