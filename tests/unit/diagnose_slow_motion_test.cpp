#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diagnose/signals/slow_motion.hpp"

namespace morepro::host {
namespace {

constexpr double kMassKg = 2.0;

std::optional<RecordingSignals> seen_slowly(const RecordingSignals& signals, double position_noise_m) {
  MonitorConfiguration configuration = reference_configuration();
  configuration.machine.feed.mass_kg = kMassKg;
  configuration.sensors.by_channel[index_of(Channel::kFeedPosition)] = {position_noise_m, 0.0};
  return slow_motion_of(signals, configuration);
}

/// A force that changes its sign in the middle of every 5 ms, at 1 kHz, with a mean of 1 N.
RecordingSignals swinging(float amplitude_n) {
  RecordingSignals signals;
  signals.rate_hz = 1000.0;
  signals.rows = 2000;
  signals.recorded = static_cast<std::uint16_t>(bit_of(Channel::kFeedForce) | bit_of(Channel::kFeedPosition));
  signals.value[index_of(Channel::kFeedPosition)].assign(signals.rows, 0.0F);
  for (std::size_t i = 0; i < signals.rows; ++i) {
    const std::size_t place = i % 5;
    const float swing = place < 2 ? amplitude_n : place > 2 ? -amplitude_n : 0.0F;
    signals.value[index_of(Channel::kFeedForce)].push_back(1.0F + swing);
  }
  return signals;
}

// Two samples of +A and two of -A around the middle: A (2 + 1 + 1 + 2) steps^2 / m.
TEST(SlowMotion, IsOneWhereMeansOfTheForceDoTheSame) {
  constexpr double kErrorM = 6.0 * 1.0e-6 / kMassKg;  // of 1 N
  EXPECT_TRUE(seen_slowly(swinging(1.0F), 1.01 * kErrorM));
  EXPECT_FALSE(seen_slowly(swinging(1.0F), 0.99 * kErrorM));
  EXPECT_TRUE(seen_slowly(swinging(0.0F), 1.0e-12));
}

TEST(SlowMotion, IsOfNoAxisWhoseSpeedIsKnown) {
  RecordingSignals signals = swinging(0.0F);
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kFeedSpeed));
  signals.value[index_of(Channel::kFeedSpeed)].assign(signals.rows, 0.0F);
  EXPECT_FALSE(seen_slowly(signals, 1.0e-6));
}

TEST(SlowMotion, IsAtTwoHundredHertz) {
  const auto slow = seen_slowly(swinging(0.0F), 1.0e-6);
  ASSERT_TRUE(slow);
  EXPECT_EQ(slow->rate_hz, 200.0);
  EXPECT_EQ(slow->rows, 400U);
  RecordingSignals slow_already = swinging(0.0F);
  slow_already.rate_hz = 250.0;
  EXPECT_FALSE(seen_slowly(slow_already, 1.0e-6));
}

}  // namespace
}  // namespace morepro::host
