// A mass that is not the same along the way: no name of the catalogue, and no fault of the datasheet either.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

constexpr double kRateHz = 5000.0;

/// Where the axis is to be: slowly along all of its way, and shaken, so that no place has a force of its own.
double wanted_m(double time_s) {
  return 0.05 * std::sin(time_s) + 0.004 * std::sin(31.0 * time_s) + 0.001 * std::sin(83.0 * time_s);
}

/// An axis behind a plain controller, its mass (1 + share * sin(place / 20 mm)) of the datasheet's.
RecordingSignals axis_with_mass_over_place(double share) {
  constexpr int kSteps = 20;
  constexpr double kStepS = 1.0 / (kRateHz * kSteps);
  const MonitorConfiguration configuration = reference_configuration();
  const auto& feed = configuration.machine.feed;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = 40000;
  const auto show = [&](Channel channel, double value) {
    signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(channel));
    const double noise = configuration.sensors.by_channel[index_of(channel)].noise;
    signals.value[index_of(channel)].push_back(static_cast<float>(value + noise * normal(random)));
  };
  double place_m = 0.0;
  double speed_m_s = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double ahead_m = wanted_m(signals.time_s(row)) - place_m;
    const double force_n = feed.mass_kg * (4.0e4 * ahead_m - 300.0 * speed_m_s);
    show(Channel::kFeedForce, force_n);
    show(Channel::kFeedSpeed, speed_m_s);
    show(Channel::kFeedPosition, place_m);
    for (int step = 0; step < kSteps; ++step) {
      const double mass_kg = feed.mass_kg * (1.0 + share * std::sin(place_m / 0.02));
      const double change_m_s = kStepS * (force_n - feed.viscous_friction_ns_m * speed_m_s) /
                                (mass_kg + 0.5 * kStepS * feed.viscous_friction_ns_m);
      place_m += kStepS * (speed_m_s + 0.5 * change_m_s);
      speed_m_s += change_m_s;
    }
  }
  return signals;
}

// Ten times what the mass is known to, and too little for anything else that has no name to show it.
TEST(PlaceDependentMass, IsUnexplained) {
  const DiagnosisResult result = diagnosed(axis_with_mass_over_place(5.0e-4), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.which.empty()) << said(result);
}

TEST(PlaceDependentMass, IsNoneWhereItIsTheSameEverywhere) {
  const DiagnosisResult result = diagnosed(axis_with_mass_over_place(0.0), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
