#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "lib/gap/jitter_watch.hpp"

namespace morepro::jitter_watch_test {
namespace {

using Watch = gap::JitterWatch<float>;

constexpr std::size_t kSensor = 1;
constexpr double kVariance = 0.04;

/// Innovations of a sensor whose rate swings, in intervals; `error`: what they have beside noise, of the rate
/// and of what a clock with a jitter of one interval would be late by.
struct Innovations {
  std::function<double(double rate, double late)> error = [](double, double) { return 0.0; };
  double noise = 1.0;  ///< as a share of what is expected
  std::size_t sensor = kSensor;
  double known = 0.0;  ///< jitter, as a share of an interval
  int rows = 6000;
};

void show(const Innovations& innovations, Watch& watch, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < innovations.rows; ++i) {
    const double rate = std::sin(0.05 * i) + 0.3 * std::sin(0.41 * i);
    const double noise = innovations.noise * std::sqrt(kVariance) * normal(random);
    const double variance = kVariance + std::pow(innovations.known * rate, 2);
    watch.see(innovations.sensor,
              {.innovation = static_cast<float>(noise + innovations.error(rate, normal(random))),
               .variance = static_cast<float>(variance),
               .rate = static_cast<float>(rate),
               .most = static_cast<float>(6.0 * std::sqrt(variance))});
  }
}

Watch::Jitter after(const Innovations& innovations) {
  Watch watch;
  show(innovations, watch);
  return watch.jitter();
}

double jittering(double rate, double late) { return 0.2 * rate * late; }

TEST(JitterWatch, KnowsHowLateSamplesAre) {
  const auto jitter = after({.error = jittering});
  EXPECT_GT(jitter.evidence, 100.0F);
  // The slope of 6000 squares is known to 4 %, its root to half of that.
  EXPECT_NEAR(std::sqrt(jitter.variance), 0.2, 0.2 * 0.08);
}

TEST(JitterWatch, FindsNoneInNoiseOfAnySize) {
  for (const double noise : {0.2, 1.0, 5.0}) EXPECT_EQ(after({.noise = noise}).evidence, 0.0F) << noise;
}

TEST(JitterWatch, AWrongLawIsNone) {
  EXPECT_EQ(after({.error = [](double rate, double) { return 0.3 * rate; }}).evidence, 0.0F);
}

TEST(JitterWatch, WhatIsKnownIsNone) { EXPECT_EQ(after({.error = jittering, .known = 0.2}).evidence, 0.0F); }

TEST(JitterWatch, WhatIsMuchLessThanTheNoiseDoesNotMatter) {
  const auto little = [](double rate, double late) { return 0.08 * rate * late; };
  EXPECT_EQ(after({.error = little, .rows = 60000}).evidence, 0.0F);
}

TEST(JitterWatch, AllSensorsShareOneClock) {
  Watch watch;
  show({.error = jittering}, watch);
  show({.sensor = kSensor + 1}, watch);
  EXPECT_EQ(watch.jitter().evidence, 0.0F);
}

TEST(JitterWatch, TooFewRowsTellNothing) {
  const auto strongly = [](double rate, double late) { return 0.4 * rate * late; };
  const auto evidence_of_three = [&strongly](int rows) {
    Watch watch;
    for (std::size_t sensor = 0; sensor < 3; ++sensor)
      show({.error = strongly, .sensor = sensor, .rows = rows}, watch, static_cast<unsigned>(sensor));
    return watch.jitter().evidence;
  };
  EXPECT_EQ(evidence_of_three(399), 0.0F);
  EXPECT_GT(evidence_of_three(400), 0.0F);
}

TEST(JitterWatch, MergesWhatOthersHaveSeen) {
  Watch one;
  Watch other;
  show({.error = jittering, .rows = 3000}, one, 1);
  show({.error = jittering, .rows = 3000}, other, 2);
  const float alone = one.jitter().evidence;
  one.merge(other);
  EXPECT_NEAR(one.jitter().evidence / alone, 2.0, 0.5);
}

TEST(JitterWatch, ForgetsSlowly) {
  Watch watch;
  show({.rows = 150000}, watch);
  show({.error = jittering, .rows = 60000}, watch);
  // Of all 210,000 rows it would be 0.29 of the jitter's variance.
  EXPECT_GT(watch.jitter().variance, 0.5F * 0.2F * 0.2F);
}

TEST(JitterWatch, LeavesOutWhatIsNoNumber) {
  Watch watch;
  show({.error = jittering}, watch);
  const auto before = watch.jitter();
  const float nan = std::nanf("");
  watch.see(kSensor, {.innovation = nan, .variance = 1.0F, .rate = 1.0F, .most = 6.0F});
  watch.see(kSensor, {.innovation = 1.0F, .variance = 0.0F, .rate = 1.0F, .most = 6.0F});
  EXPECT_EQ(watch.jitter().variance, before.variance);
  EXPECT_EQ(watch.jitter().evidence, before.evidence);
}

}  // namespace
}  // namespace morepro::jitter_watch_test
