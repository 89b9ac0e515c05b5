// A speed that a counter shows: the difference of two rounded positions, half a sample old.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim_host/diagnose/signals/differenced_speed.hpp"
#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

constexpr double kStep = 0.005;  // m/s

RecordingSignals with_feed_speed(const std::function<double(int)>& speed) {
  RecordingSignals signals;
  for (int row = 0; row < 4000; ++row) show(signals, Channel::kFeedSpeed, speed(row));
  signals.rows = 4000;
  return signals;
}

/// Of a sensor that is stated to have so much noise, in steps, after it was looked at.
double noise_in_steps(const RecordingSignals& signals, double stated = 0.0) {
  Sensors sensors{};
  sensors[Channel::kFeedSpeed] = {.noise = stated * kStep, .lsb = kStep};
  host::allow_for_differences(signals, sensors);
  return sensors[Channel::kFeedSpeed].noise / kStep;
}

double wanted_m_s(int row) { return 0.1 * std::sin(0.002 * row); }

TEST(DifferencedSpeed, HasTwoRoundings) {
  double place_m = 0.0;
  double last = 0.0;
  const auto counted = with_feed_speed([&](int row) {
    place_m += wanted_m_s(row);
    const double rounded = std::round(place_m / kStep);
    return kStep * (rounded - std::exchange(last, rounded));
  });
  EXPECT_NEAR(noise_in_steps(counted), std::sqrt(1.0 / 12.0), 1.0e-12);
  EXPECT_DOUBLE_EQ(noise_in_steps(counted, 0.5), 0.5) << "whose noise says as much already";
}

TEST(DifferencedSpeed, IsNoRoundedOne) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto rounded = [](double speed) { return kStep * std::round(speed / kStep); };
  EXPECT_EQ(noise_in_steps(with_feed_speed([&](int row) { return rounded(wanted_m_s(row)); })), 0.0);
  const auto noisy =
      with_feed_speed([&](int row) { return rounded(wanted_m_s(row) + 0.24 * kStep * normal(random)); });
  EXPECT_DOUBLE_EQ(noise_in_steps(noisy, 0.24), 0.24);
  EXPECT_EQ(noise_in_steps(with_feed_speed([](int) { return 0.0; })), 0.0) << "at rest";
}

/// A position in steps of 1 um that is known to half of one, and a speed that `speed_of` makes of it and of
/// where the axis is, all in steps and rows, in steps of its own.
template <class SpeedOf>
RecordingSignals with_position_and(SpeedOf speed_of, double rad_per_row = 0.01) {
  constexpr int kRows = 4000;
  constexpr double kFiner = 24.0;  // than the position's steps: a difference over 2, 6 or 8 rows is exact
  RecordingSignals signals;
  signals.rate_hz = 1000.0;
  signals.rows = kRows;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.5);
  std::vector<double> place(kRows);
  std::vector<double> shown(kRows);
  for (int row = 0; row < kRows; ++row) {
    place[row] = 3000.0 * std::sin(rad_per_row * row);
    shown[row] = std::round(place[row] + noise(random));
  }
  for (int row = 0; row < kRows; ++row) {
    show(signals, Channel::kFeedPosition, 1.0e-6 * shown[row]);
    const bool is_inside = row > 0 && row + 1 < kRows;
    show(signals, Channel::kFeedSpeed,
         is_inside ? 1.0e-3 / kFiner * std::round(kFiner * speed_of(shown, place, row)) : 0.0);
  }
  return signals;
}
using Places = std::vector<double>;

TEST(DerivedSpeed, IsLeftOut) {
  const auto is_left_out = [](auto speed_of) {
    RecordingSignals signals = with_position_and(speed_of);
    const bool is = host::leave_out_derived_speed(signals);
    EXPECT_EQ(signals.has(Channel::kFeedSpeed), !is);
    return is;
  };
  EXPECT_TRUE(is_left_out([](const Places& x, const Places&, int k) { return x[k] - x[k - 1]; }));
  EXPECT_TRUE(is_left_out([](const Places& x, const Places&, int k) { return x[k + 1] - x[k]; }));
  EXPECT_TRUE(is_left_out([](const Places& x, const Places&, int k) { return 0.5 * (x[k + 1] - x[k - 1]); }));
  // Drives that count over several samples: with as many after as before, and with what was so far.
  const auto over = [](const Places& x, int from, int to) {
    const int last = static_cast<int>(x.size()) - 1;
    return (x[std::min(to, last)] - x[std::max(from, 0)]) / (to - from);
  };
  EXPECT_TRUE(is_left_out([&](const Places& x, const Places&, int k) { return over(x, k - 3, k + 3); }));
  EXPECT_TRUE(is_left_out([&](const Places& x, const Places&, int k) { return over(x, k - 8, k); }));
  EXPECT_FALSE(is_left_out([&](const Places&, const Places& at, int k) { return over(at, k - 3, k + 3); }));
  EXPECT_FALSE(is_left_out([](const Places&, const Places& at, int k) {
    return 0.5 * (at[k + 1] - at[k - 1]);
  })) << "it has a sensor of its own";
  // So fast that motion is all that is seen, a thousandth of it the sensor's noise.
  const auto noisy = [](const Places&, const Places& at, int k) {
    return 0.5 * (at[k + 1] - at[k - 1]) + 2.0 * std::sin(17.0 * k);
  };
  RecordingSignals fast = with_position_and(noisy, 0.6);
  EXPECT_FALSE(host::leave_out_derived_speed(fast));
}

// What such a sensor has beside its noise, and all that it has.
TEST(DifferencedSpeed, IsHalfASampleLateAndNothingElse) {
  DrivenAxis axis{.rows = 20000, .position_noise_m = 1.0e-7};
  RecordingSignals signals = record(axis);
  auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  const auto& place = signals.value[index_of(Channel::kFeedPosition)];
  const double counted_m = kStep / axis.rate_hz;
  for (std::size_t row = signals.rows - 1; row > 0; --row) {
    const auto count = [&](std::size_t i) { return std::round(static_cast<double>(place[i]) / counted_m); };
    speed[row] = static_cast<float>(kStep * (count(row) - count(row - 1)));
  }
  speed[0] = 0.0F;
  MachineDescription sheet = datasheet(0.05);
  sheet.configuration.sensors[Channel::kFeedSpeed] = {.noise = 0.0, .lsb = kStep};
  sheet.configuration.sensors[Channel::kFeedPosition].noise = axis.position_noise_m;
  const auto result = diagnosed(std::move(signals), sheet);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kFeedSpeedDelay);
  EXPECT_NEAR(result.which.front().magnitude, 0.5 / axis.rate_hz, 3.0 * result.which.front().standard_error);
}

}  // namespace
}  // namespace morepro::diagnose_test
