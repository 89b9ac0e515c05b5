#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kHeatingRows = 2000;
constexpr double kHeatingRateHz = 10000.0;

/// A tool that heats by `slope` degC/s, with noise of its sensor.
RecordingSignals heating(double slope_degc_s, double noise_degc) {
  RecordingSignals signals;
  signals.rate_hz = kHeatingRateHz;
  signals.rows = kHeatingRows;
  signals.recorded = bit_of(Channel::kToolTemperature);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, noise_degc);
  auto& tool = signals.value[index_of(Channel::kToolTemperature)];
  for (std::size_t row = 0; row < kHeatingRows; ++row)
    tool.push_back(static_cast<float>(20.0 + slope_degc_s * signals.time_s(row) + noise(random)));
  return signals;
}

// A float of 400 is known to 3e-5. A mean of the last 4 ms would be 8 degC behind.
TEST(CalmTemperature, DoesNotLagBehindAToolThatHeats) {
  RecordingSignals signals = heating(2000.0, 1.0e-9);
  calm_temperatures(signals);
  for (std::size_t row = 0; row < kHeatingRows; ++row)
    ASSERT_NEAR(signals.calm_tool_degc[row], signals.value[index_of(Channel::kToolTemperature)][row], 1.0e-4)
        << row;
}

double deviation(const RecordingSignals& signals, std::size_t first, std::size_t last, double from) {
  double squares = 0.0;
  for (std::size_t row = first; row < last; ++row)
    squares += std::pow(static_cast<double>(signals.calm_tool_degc[row]) - from, 2);
  return std::sqrt(squares / static_cast<double>(last - first));
}

// Up to 641 of 2000 samples: a 25th of the noise. With 81 of them, some law of the temperature explained what
// the noise did to the torque.
TEST(CalmTemperature, IsWithoutNoiseWhereItRests) {
  RecordingSignals signals = heating(0.0, 0.9);
  calm_temperatures(signals);
  EXPECT_LT(deviation(signals, 320, kHeatingRows - 320, 20.0), 0.9 / 15.0);
}

// Means that do not agree are not taken: 41 samples of the ramp in a mean of 81 are 2 degC, at the very bend.
TEST(CalmTemperature, IsNotSmearedWhereHeatingBegins) {
  constexpr std::size_t kBegin = 1000;
  constexpr double kSlopeDegcS = 2000.0;
  RecordingSignals signals = heating(0.0, 0.5);
  auto& tool = signals.value[index_of(Channel::kToolTemperature)];
  for (std::size_t row = kBegin; row < kHeatingRows; ++row)
    tool[row] += static_cast<float>(kSlopeDegcS * static_cast<double>(row - kBegin) / kHeatingRateHz);
  calm_temperatures(signals);
  for (std::size_t row = 0; row < kHeatingRows; ++row) {
    const double heated =
        row < kBegin ? 0.0 : kSlopeDegcS * static_cast<double>(row - kBegin) / kHeatingRateHz;
    const bool is_bend = row + 80 > kBegin && row < kBegin + 80;
    ASSERT_NEAR(static_cast<double>(signals.calm_tool_degc[row]) - 20.0, heated, is_bend ? 3.0 : 0.6) << row;
  }
}

TEST(CalmTemperature, IsMissingWhereItsSampleIs) {
  RecordingSignals signals = heating(0.0, 0.5);
  auto& tool = signals.value[index_of(Channel::kToolTemperature)];
  for (std::size_t row = 100; row < 300; ++row) tool[row] = std::numeric_limits<float>::quiet_NaN();
  calm_temperatures(signals);
  for (std::size_t row = 0; row < kHeatingRows; ++row)
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
