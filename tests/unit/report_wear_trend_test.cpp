// The line through a tool's wear: exact where it is one, and an error that is true where estimates are alike.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim_host/report/wear_trend.hpp"

namespace morepro::host {
namespace {

constexpr double kTrendRateHz = 1000.0;

TEST(WearTrend, FindsALineWhateverItsLength) {
  for (const int samples : {16, 17, 1000, 100'000}) {
    WearTrend trend;
    for (int k = 0; k < samples; ++k) trend.take(5.0 + k / kTrendRateHz, 1.1 + 0.02 * k / kTrendRateHz);
    const auto line = trend.line();
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->slope_per_s, 0.02, 1e-9);
    EXPECT_NEAR(line->at(5.0), 1.1, 1e-9);
    EXPECT_LT(line->standard_error_per_s, 1e-9);
    EXPECT_GE(line->from_s, 5.0);
    EXPECT_LE(line->to_s, 5.0 + samples / kTrendRateHz);
  }
}

TEST(WearTrend, SaysNothingAboutTooFewSamplesOrThoseOfAnotherTool) {
  WearTrend trend;
  EXPECT_FALSE(trend.line());
  for (int k = 0; k < 15; ++k) trend.take(k, 1.0);
  EXPECT_FALSE(trend.line());
  for (int k = 15; k < 40; ++k) trend.take(k, k < 20 ? 1.0 : std::nan(""));
  EXPECT_TRUE(trend.line());
  trend.restart();
  EXPECT_FALSE(trend.line());
}

TEST(WearTrend, GoesOnOverAPauseInTheAir) {
  WearTrend trend;
  for (int k = 0; k < 4000; ++k)
    if (k < 1000 || k >= 3000) trend.take(k / kTrendRateHz, 1.0 + 0.1 * k / kTrendRateHz);
  EXPECT_NEAR(trend.line()->slope_per_s, 0.1, 1e-9);
}

/// Share of runs in which the slope lies within two standard errors of the truth. `memory_s`: correlation
/// time of the noise; 0: white.
double coverage(double memory_s, int runs) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const double keep = memory_s > 0.0 ? std::exp(-1.0 / (memory_s * kTrendRateHz)) : 0.0;
  int within = 0;
  for (int run = 0; run < runs; ++run) {
    WearTrend trend;
    double noise = normal(random);
    for (int k = 0; k < 4000; ++k) {
      noise = keep * noise + std::sqrt(1.0 - keep * keep) * normal(random);
      trend.take(k / kTrendRateHz, 1.0 + 0.02 * k / kTrendRateHz + 0.05 * noise);
    }
    const auto line = trend.line();
    if (std::fabs(line->slope_per_s - 0.02) < 2.0 * line->standard_error_per_s) ++within;
  }
  return within / static_cast<double>(runs);
}

TEST(WearTrend, ItsErrorIsNotTooSmallHoweverSlowlyEstimatesWander) {
  // 95 % are due; 300 runs scatter by 1.3 %.
  for (const double memory_s : {0.0, 0.02, 0.1, 0.5, 4.0})
    EXPECT_GE(coverage(memory_s, 300), 0.91) << memory_s;
}

TEST(WearTrend, OfWhiteNoiseItsErrorIsThatOfLeastSquares) {
  constexpr int kRuns = 200;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  double mean = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    WearTrend trend;
    for (int k = 0; k < 4096; ++k) trend.take(k / kTrendRateHz, 0.05 * normal(random));
    mean += trend.line()->standard_error_per_s / kRuns;
  }
  const double expected = 0.05 / (4.096 / std::sqrt(12.0)) / std::sqrt(4096.0);
  // Values that look alike by chance are allowed for, those that look unlike are not.
  EXPECT_GT(mean, 0.98 * expected);
  EXPECT_LT(mean, 1.4 * expected);
}

}  // namespace
}  // namespace morepro::host
