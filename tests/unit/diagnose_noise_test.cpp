#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/diagnose/leftover/spectral_lines.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kLength = 8192;

std::vector<float> white(unsigned seed, std::size_t length = kLength) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal;
  std::vector<float> values(length);
  for (float& value : values) value = normal(engine);
  return values;
}

TEST(SpectralLines, FindsNoneInWhiteNoise) {
  for (unsigned seed = 1; seed <= 50; ++seed) EXPECT_EQ(find_lines(white(seed)).gain, 0.0) << "seed " << seed;
}

TEST(SpectralLines, TakesASinesWholePower) {
  constexpr double kAmplitude = 0.25;
  auto values = white(7);
  for (std::size_t i = 0; i < kLength; ++i)
    values[i] += static_cast<float>(
        kAmplitude * std::sin(2.0 * std::numbers::pi * 300.0 * static_cast<double>(i) / kLength + 0.4));
  // n A^2 / 2; a noncentral chi-square of two degrees of freedom spreads by sqrt(4 + 4 x 256), four times
  // that.
  const double expected = kLength * kAmplitude * kAmplitude / 2.0;
  EXPECT_NEAR(find_lines(values).gain, expected, 4.0 * std::sqrt(4.0 + 4.0 * expected));
}

TEST(SpectralLines, DoNotDependOnTheSequencesUnit) {
  auto values = white(7);
  for (std::size_t i = 0; i < kLength; ++i) values[i] += 0.3F * std::sin(0.2F * static_cast<float>(i));
  auto scaled = values;
  for (float& value : scaled) value *= 0.5F;
  EXPECT_GT(find_lines(values).gain, 100.0);
  EXPECT_NEAR(find_lines(scaled).gain, find_lines(values).gain, 1.0e-3 * find_lines(values).gain);
}

TEST(SpectralLines, AreOneForEachSine) {
  auto values = white(7);
  const auto add = [&values](double cycles, double amplitude) {
    for (std::size_t i = 0; i < kLength; ++i)
      values[i] += static_cast<float>(
          amplitude * std::sin(2.0 * std::numbers::pi * cycles * static_cast<double>(i) / kLength));
  };
  add(300.5, 2.0);  // between two frequencies: in many of them
  add(310.0, 0.5);
  add(1000.0, 0.2);
  const SpectralLines found = find_lines(values);
  ASSERT_EQ(found.lines.size(), 3U);
  EXPECT_NEAR(kLength * found.lines[0].cycles_per_sample, 300.5, 0.6);
  EXPECT_NEAR(kLength * found.lines[1].cycles_per_sample, 310.0, 0.1);
  EXPECT_NEAR(kLength * found.lines[2].cycles_per_sample, 1000.0, 0.1);
}

TEST(SpectralLines, AreOneForASineThatDrifts) {
  auto values = white(7);
  for (std::size_t i = 0; i < kLength; ++i) {
    const double part = static_cast<double>(i) / kLength;
    const double turns = 700.0 * part + 1.5 * part * part;  // by three frequencies
    values[i] += static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * turns));
  }
  EXPECT_EQ(find_lines(values).lines.size(), 1U);
}

TEST(SpectralLines, AreNotLookedForInAFewSamples) {
  std::vector<float> values(255);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(0.5F * static_cast<float>(i));
  EXPECT_EQ(find_lines(values).gain, 0.0);
}

/// Noise of memory 0.8 and unit variance, three times as large in the air and five times in contact, which
/// changes every 1000 samples.
GapStatistics remembering(std::size_t length) {
  GapStatistics statistics;
  const auto drawn = white(11, length);
  float state = 0.0F;
  for (std::size_t i = 0; i < length; ++i) {
    state = 0.8F * state + 0.6F * drawn[i];
    const bool contact = i / 1000 % 2 == 1;
    statistics.normalised[0].push_back((contact ? 5.0F : 3.0F) * state);
    statistics.in_contact[0].push_back(contact);
  }
  return statistics;
}

double correlation(const std::vector<float>& values, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < values.size(); ++i)
    sum += static_cast<double>(values[i]) * static_cast<double>(values[i - lag]);
  return sum / static_cast<double>(values.size());
}

TEST(Whitening, FindsTheScalesInTheAirAndInContact) {
  const auto statistics = remembering(100000);
  const SensorWhitening white = whitening_of(statistics)[0];
  // Memory 0.8 leaves 50000 (1 - 0.64) / (1 + 0.64) = 11000 independent squares: five standard errors of the
  // scale.
  EXPECT_NEAR(white.scale[0], 3.0, 3.0 * 5.0 / std::sqrt(2.0 * 11000.0));
  EXPECT_NEAR(white.scale[1], 5.0, 5.0 * 5.0 / std::sqrt(2.0 * 11000.0));
  EXPECT_NEAR(white.left, 1.0 - 0.64, 0.01);
}

TEST(Whitening, MakesRememberingNoiseWhite) {
  const auto statistics = remembering(100000);
  const auto values = white_innovations(statistics, 0, whitening_of(statistics)[0]);
  EXPECT_NEAR(correlation(values, 0), 1.0, 0.03);
  for (std::size_t lag = 1; lag <= 30; ++lag)
    EXPECT_NEAR(correlation(values, lag), 0.0, 4.5 / std::sqrt(100000.0)) << "lag " << lag;
}

TEST(Whitening, LeavesWhiteNoiseAlone) {
  GapStatistics statistics;
  statistics.normalised[0] = white(5, 20000);
  statistics.in_contact[0].assign(20000, false);
  const SensorWhitening found = whitening_of(statistics)[0];
  for (const double memory : found.memory) EXPECT_NEAR(memory, 0.0, 4.5 / std::sqrt(20000.0));
  EXPECT_EQ(found.scale[0], found.scale[1]);
}

TEST(Whitening, IsNotEstimatedFromAFewSamples) {
  const auto statistics = remembering(399);
  EXPECT_EQ(whitening_of(statistics)[0].scale, (std::array{1.0, 1.0}));
  EXPECT_EQ(whitening_of(statistics)[0].left, 1.0);
}

// A hundred samples in the air, twenty times as large as those in contact: a model that is wrong there may
// not pass for one that is right.
TEST(Whitening, CountsASeldomStateAlong) {
  GapStatistics statistics;
  const auto drawn = white(13, 10000);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool contact = i >= 100;
    statistics.normalised[0].push_back((contact ? 1.0F : 20.0F) * drawn[i]);
    statistics.in_contact[0].push_back(contact);
  }
  const SensorWhitening found = whitening_of(statistics)[0];
  const double pooled = std::sqrt(0.99 + 0.01 * 400.0);
  // A hundred squares spread by a seventh, and are four fifths of the sum: five standard errors of the scale.
  EXPECT_NEAR(found.scale[1], pooled, 5.0 * pooled * 0.5 * 0.8 / 7.0);
  EXPECT_EQ(found.scale[0], found.scale[1]);
}

TEST(Whitening, DoesNotTakeItsMemoryFromAFewOutliers) {
  auto statistics = remembering(100000);
  for (std::size_t i = 500; i < 100000; i += 10000) statistics.normalised[0][i] = 2000.0F;
  const auto clean = whitening_of(remembering(100000))[0].memory;
  for (std::size_t j = 0; j < clean.size(); ++j)
    EXPECT_TRUE(std::isfinite(whitening_of(statistics)[0].memory[j]));
  EXPECT_GT(whitening_of(statistics)[0].memory[0], 0.5 * clean[0]);
}

// What a wrong model leaves where a machine runs up, and white noise of one for good: whatever remembers it,
// of each row that noise is new. By the covariances of the memory three thousandths of it were left, and a
// wrong model was likelier than the right one, by 6 per row.
TEST(Whitening, LeavesAtLeastWhatIsNew) {
  for (const double size : {30.0, 300.0, 3000.0}) {
    GapStatistics statistics;
    const auto drawn = white(17, 5000);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      statistics.normalised[0].push_back(
          drawn[i] + static_cast<float>(size * std::exp(-static_cast<double>(i) / 300.0)));
    statistics.in_contact[0].assign(drawn.size(), false);
    const SensorWhitening found = whitening_of(statistics)[0];
    EXPECT_GT(found.left * found.scale[0] * found.scale[0], 0.9) << size;
  }
}

/// Innovations of both sensors, as an observer of the right noise leaves them.
GapStatistics two_sensors(unsigned seed, std::size_t rows) {
  GapStatistics statistics;
  statistics.normalised = {white(seed, rows), white(seed + 1000, rows)};
  for (auto& contact : statistics.in_contact) contact.assign(rows, false);
  return statistics;
}

TEST(PredictableDeviance, IsNothingInWhiteNoise) {
  for (unsigned seed = 1; seed <= 50; ++seed) EXPECT_EQ(predictable_deviance(two_sensors(seed, 20000)), 0.0);
}

TEST(PredictableDeviance, SeesWhatOneSensorSaysOfTheOtherLater) {
  constexpr std::size_t kRows = 100000;
  constexpr float kShare = 0.05F;
  auto statistics = two_sensors(3, kRows);
  auto& [speed, current] = statistics.normalised;
  for (std::size_t i = kRows; i-- > 5;) current[i] += kShare * speed[i - 5];
  // n rho^2 = 250, a noncentral chi-square that spreads by 32, less four deviations of 96 chi-squares, 55.
  EXPECT_NEAR(predictable_deviance(statistics), 250.0 - 55.0, 4.0 * 35.0);
  EXPECT_GT(predictable_deviance(statistics), 0.0);
}

TEST(PredictableDeviance, DoesWithoutASensor) {
  auto statistics = two_sensors(4, 20000);
  statistics.normalised[1].clear();
  statistics.in_contact[1].clear();
  EXPECT_EQ(predictable_deviance(statistics), 0.0);
}

}  // namespace
}  // namespace morepro::host
