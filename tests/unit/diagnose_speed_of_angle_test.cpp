// A spindle of which the angle alone is recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim_host/diagnose/signals/speed_of_angle.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// Without its speed, and with the angle that a fine encoder shows: within a turn, or all of them.
RecordingSignals known_by_angle(const std::vector<gap::AppliedEffect>& effects, bool is_within_turn) {
  RecordingSignals signals = record({.effects = effects, .duration_s = 4.0});
  auto& angle = signals.value[index_of(Channel::kSpindleAngle)];
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  double turned = 0.0;
  angle.resize(signals.rows);
  for (std::size_t row = 0; row < signals.rows; ++row) {
    angle[row] = static_cast<float>(is_within_turn ? std::remainder(turned, 2.0 * std::numbers::pi) : turned);
    turned += 0.01 + 0.005 * std::sin(1.0e-3 * static_cast<double>(row));
  }
  speed.clear();
  signals.recorded = static_cast<std::uint16_t>((signals.recorded | bit_of(Channel::kSpindleAngle)) &
                                                ~bit_of(Channel::kSpindleSpeed));
  return signals;
}

TEST(SpeedOfAngle, IsThatOfTheRow) {
  for (const bool is_within_turn : {false, true}) {
    RecordingSignals signals = known_by_angle({}, is_within_turn);
    Sensors sensors = reference_sensors();
    sensors[Channel::kSpindleAngle] = {.noise = 1.0e-4, .lsb = 0.0};
    ASSERT_TRUE(host::take_speed_from_angle(signals, sensors));
    const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
    EXPECT_TRUE(std::isnan(speed.front()) && std::isnan(speed.back()));
    // Between the increments before and after; a float of the angle is known to 3e-5 rad.
    for (std::size_t row = 1; row + 1 < signals.rows; ++row)
      ASSERT_NEAR(speed[row],
                  signals.rate_hz * (0.01 + 0.005 * std::sin(1.0e-3 * (static_cast<double>(row) - 0.5))),
                  0.35)
          << row;
    EXPECT_NEAR(sensors[Channel::kSpindleSpeed].noise, signals.rate_hz * 1.0e-4 / std::sqrt(2.0),
                0.1 * sensors[Channel::kSpindleSpeed].noise);
    EXPECT_FALSE(host::take_speed_from_angle(signals, sensors)) << "it has one now";
  }
}

}  // namespace
}  // namespace morepro::diagnose_test
