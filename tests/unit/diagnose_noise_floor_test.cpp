#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim_host/diagnose/balances/noise_floor.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kWindows = 780;  // of a recording of 100,000 rows

/// Rows of a white noise of power one, every third stretch of 60 windows in contact and three times louder.
std::vector<WindowResidual> noise(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<WindowResidual> windows(kWindows);
  for (std::size_t i = 0; i < kWindows; ++i) {
    windows[i].first = i * kWindowLength / 2;
    windows[i].in_contact = i / 60 % 3 == 0;
    for (double& row : windows[i].row) row = (windows[i].in_contact ? std::sqrt(3.0) : 1.0) * normal(random);
  }
  return windows;
}

TEST(NoiseFloor, IsAllOfWhatNoiseLeaves) {
  for (unsigned seed = 1; seed <= 50; ++seed)
    for (const auto& band : noise_shares(noise(seed)))
      for (const double share : band) EXPECT_EQ(share, 1.0) << "seed " << seed;
}

TEST(NoiseFloor, IsLessWhereSomethingLasts) {
  auto windows = noise(1);
  for (WindowResidual& window : windows) window.row[0] += 2.0;
  const NoiseShares shares = noise_shares(windows);
  // A power of four beside one and three, known to the mean of 500 and of 260 windows, four deviations.
  EXPECT_NEAR(shares[0][false], 1.0 / 5.0, 0.1);
  EXPECT_NEAR(shares[0][true], 3.0 / 7.0, 0.18);
  for (std::size_t band = 1; band < kBands; ++band)
    for (const double share : shares[band]) EXPECT_EQ(share, 1.0);
}

TEST(NoiseFloor, IsLessWhereAWaveGoesOn) {
  auto windows = noise(2);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const double angle = 0.7 * static_cast<double>(i);
    windows[i].row[3] += 2.0 * std::cos(angle);
    windows[i].row[4] += 2.0 * std::sin(angle);
  }
  const NoiseShares shares = noise_shares(windows);
  // A power of four in two rows, on average two per row, beside one.
  EXPECT_NEAR(shares[2][false], 1.0 / 3.0, 0.1);
  EXPECT_EQ(shares[1][false], 1.0);
  EXPECT_EQ(shares[3][false], 1.0);
}

TEST(NoiseFloor, IsLessWhereFewWindowsAreLoud) {
  auto windows = noise(3);
  for (std::size_t i = 5; i < windows.size(); i += 20)
    for (const std::size_t row : {1U, 2U}) windows[i].row[row] = 10.0;
  const NoiseShares shares = noise_shares(windows);
  // One in twenty has a hundred times the power, 5.95 on average, and moves the median by 8 %; four
  // deviations of the median of 1000 are 20 %.
  EXPECT_NEAR(shares[1][false], 1.08 / 5.95, 0.04);
  EXPECT_EQ(shares[0][false], 1.0);
}

TEST(NoiseFloor, IsNotJudgedByFewWindows) {
  auto windows = noise(4);
  for (WindowResidual& window : windows) window.row[0] += 10.0;
  windows.resize(40);
  for (const auto& band : noise_shares(windows))
    for (const double share : band) EXPECT_EQ(share, 1.0);
}

TEST(NoiseFloor, DoesNotReachOverAHole) {
  auto windows = noise(5);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    windows[i].first = 3 * i * kWindowLength;
    windows[i].row[0] += 1.0;
  }
  // What lasts over a hole may have been somewhere else meanwhile.
  EXPECT_EQ(noise_shares(windows)[0][false], 1.0);
}

}  // namespace
}  // namespace morepro::host
