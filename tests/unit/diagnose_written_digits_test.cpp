// Columns that were written with few digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "sim_host/diagnose/signals/written_digits.hpp"

namespace morepro::host {
namespace {

/// A position that moves up to 0.4 m, known to a tenth of a micrometre, written in that format.
std::vector<float> written_as(const std::string& format) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0e-7);
  std::vector<float> column;
  for (int row = 0; row < 20000; ++row) {
    const double value = 0.4 * std::sin(1.0e-3 * row) + noise(random);
    column.push_back(std::stof(fmt::format(fmt::runtime(format), value)));
  }
  return column;
}

TEST(WrittenDigits, AreCounted) {
  EXPECT_EQ(digits_of(written_as("{:.3g}")), 3);
  EXPECT_EQ(digits_of(written_as("{:.4g}")), 4);
  EXPECT_EQ(digits_of(written_as("{:.5g}")), 5);
  EXPECT_EQ(digits_of(written_as("{:.7g}")), 0);
  EXPECT_EQ(digits_of(written_as("{}")), 0);
  EXPECT_EQ(digits_of(std::vector<float>(1000, 0.0F)), 0) << "nothing to tell them by";
  EXPECT_EQ(digits_of(std::vector<float>(20, 0.5F)), 0) << "too few";
  std::vector<float> few;
  for (int row = 0; row < 1000; ++row) few.push_back(row % 2 == 0 ? 12.0F : 0.5F);
  EXPECT_EQ(digits_of(few), 0) << "two values have as many as any";
  std::vector<float> in_steps;
  for (int row = 0; row < 1000; ++row) in_steps.push_back(static_cast<float>(50 + row % 200));
  EXPECT_EQ(digits_of(in_steps), 0) << "these are steps of one";
}

TEST(WrittenDigits, AreTheLastBitOfASensorThatIsFiner) {
  RecordingSignals signals;
  signals.rows = 20000;
  signals.recorded = bit_of(Channel::kFeedPosition);
  auto& column = signals.value[index_of(Channel::kFeedPosition)];
  column = written_as("{:.4g}");
  Sensors sensors = reference_sensors();
  const auto found = allow_for_digits(signals, sensors);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().digits, 4);
  // Three of four values are beyond 0.1 m, in steps of 0.1 mm.
  EXPECT_DOUBLE_EQ(found.front().step, 1.0e-4);
  EXPECT_DOUBLE_EQ(sensors[Channel::kFeedPosition].lsb, found.front().step);
  Sensors coarse = reference_sensors();
  coarse[Channel::kFeedPosition].lsb = 1.0e-4;
  EXPECT_TRUE(allow_for_digits(signals, coarse).empty()) << "as the file says";
  column = written_as("{:.7g}");
  EXPECT_TRUE(allow_for_digits(signals, sensors).empty());
  std::vector<float> below;
  for (int row = 0; row < 1000; ++row)
    below.push_back(row % 10 == 0 ? 0.01F : 0.000001F * static_cast<float>(9000 + row % 999));
  EXPECT_DOUBLE_EQ(written_step_of(below), 1.0e-5) << "0.01, just below it in a float";
}

}  // namespace
}  // namespace morepro::host
