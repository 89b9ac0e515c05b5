#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kRows = 2000;
constexpr double kRateHz = 10000.0;

/// A tool that heats by `slope` degC/s, with noise of its sensor.
RecordingSignals heating(double slope_degc_s, double noise_degc) {
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = kRows;
  signals.recorded = bit_of(Channel::kToolTemperature);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, noise_degc);
  auto& tool = signals.value[index_of(Channel::kToolTemperature)];
  for (std::size_t row = 0; row < kRows; ++row)
    tool.push_back(static_cast<float>(20.0 + slope_degc_s * signals.time_s(row) + noise(random)));
  return signals;
}

// A float of 400 is known to 3e-5. A mean of the last 4 ms would be 8 degC behind.
TEST(CalmTemperature, DoesNotLagBehindAToolThatHeats) {
  RecordingSignals signals = heating(2000.0, 1.0e-9);
  calm_temperatures(signals);
  for (std::size_t row = 0; row < kRows; ++row)
    ASSERT_NEAR(signals.calm_tool_degc[row], signals.value[index_of(Channel::kToolTemperature)][row], 1.0e-4)
        << row;
}

// 81 samples: a ninth of the noise; the standard deviation of 1840 of them, of which some 23 are independent,
// is known to 15 %.
TEST(CalmTemperature, HasANinthOfTheNoise) {
  RecordingSignals signals = heating(0.0, 0.9);
  calm_temperatures(signals);
  double squares = 0.0;
  for (std::size_t row = 80; row < kRows - 80; ++row)
    squares += std::pow(static_cast<double>(signals.calm_tool_degc[row]) - 20.0, 2);
  EXPECT_NEAR(std::sqrt(squares / (kRows - 160)), 0.1, 0.05);
}

TEST(CalmTemperature, IsMissingWhereItsSampleIs) {
  RecordingSignals signals = heating(0.0, 0.5);
  auto& tool = signals.value[index_of(Channel::kToolTemperature)];
  for (std::size_t row = 100; row < 300; ++row) tool[row] = std::numeric_limits<float>::quiet_NaN();
  calm_temperatures(signals);
  for (std::size_t row = 0; row < kRows; ++row)
    ASSERT_EQ(std::isnan(signals.calm_tool_degc[row]), row >= 100 && row < 300) << row;
  EXPECT_TRUE(signals.calm_winding_degc.empty());
}

// The board has no later samples to average over.
TEST(CalmTemperature, IsNotWhatABoardSees) {
  RecordingSignals signals = heating(0.0, 0.5);
  calm_temperatures(signals);
  const MachineParameters machine{};
  FrameSource calm(signals, machine, 500);
  FrameSource board(signals, machine, 500, FrameSource::Temperatures::kAsRecorded);
  EXPECT_EQ(calm.next().input.tool_temperature_degc, static_cast<double>(signals.calm_tool_degc[500]));
  EXPECT_EQ(board.next().input.tool_temperature_degc,
            static_cast<double>(signals.value[index_of(Channel::kToolTemperature)][500]));
}

}  // namespace
}  // namespace morepro::host
