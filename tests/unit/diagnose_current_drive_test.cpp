#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/diagnose/signals/current_drive.hpp"

namespace morepro::host {
namespace {

constexpr double kDrivenRateHz = 10000.0;
constexpr std::size_t kDrivenRows = 400;

/// A spindle that its current drives without friction, exactly: 1 N m/A on 1 kg m^2 each 0.1 ms.
struct Spindle {
  Spindle() {
    signals.rate_hz = kDrivenRateHz;
    signals.rows = kDrivenRows;
    double speed_rad_s = 1.0;
    for (std::size_t i = 0; i < kDrivenRows; ++i) {
      const double here_a = current_a(i);
      put(Channel::kArmatureCurrent, here_a);
      put(Channel::kSpindleSpeed, speed_rad_s);
      speed_rad_s += 0.5 * (here_a + current_a(i + 1)) / kDrivenRateHz;
    }
    model.machine.spindle.torque_constant_nm_a = 1.0;
    model.machine.spindle.inertia_kgm2 = 1.0;
    model.machine.spindle.viscous_friction_nms_rad = 0.0;
    model.noise.speed_variance = 1.0e-12;
    model.noise.current_variance = 1.0e-6;
  }
  static double current_a(std::size_t row) { return 100.0 * std::sin(0.3 * static_cast<double>(row)); }
  void put(Channel channel, double value) {
    signals.value[index_of(channel)].push_back(static_cast<float>(value));
    signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(channel));
  }
  /// The largest innovation of the speed after some rows, and how many of the current there are.
  [[nodiscard]] std::pair<double, std::size_t> innovations() const {
    double largest = 0.0;
    std::size_t of_current = 0;
    run_observer(Axis::kSpindle, signals, model, 0, kDrivenRows, [&](const Innovation& v) {
      if (v.sensor == 1) ++of_current;
      if (v.sensor == 0 && v.row > 10) largest = std::max(largest, std::fabs(v.value));
    });
    return {largest, of_current};
  }

  RecordingSignals signals;
  GapModel model;
};

TEST(CurrentDrive, MovesTheSpindleAsItsCurrentDoes) {
  Spindle spindle;
  ASSERT_TRUE(drive_by_current(spindle.signals));
  EXPECT_FALSE(spindle.signals.has_electrics());
  const auto [largest, of_current] = spindle.innovations();
  // The speed moves by up to 0.01 rad/s per row; it is stored to 24 bits of some rad/s.
  EXPECT_LT(largest, 1.0e-6);
  EXPECT_EQ(of_current, 0U);
}

TEST(CurrentDrive, DoesNotDependOnTheElectricalValues) {
  Spindle spindle;
  ASSERT_TRUE(drive_by_current(spindle.signals));
  const double before = spindle.innovations().first;
  spindle.model.machine.spindle.resistance_ohm *= 7.0;
  spindle.model.machine.spindle.inductance_h *= 0.1;
  spindle.model.machine.spindle.back_emf_constant_vs_rad *= 3.0;
  EXPECT_EQ(spindle.innovations().first, before);
}

TEST(CurrentDrive, LeavesARecordedVoltageAlone) {
  Spindle spindle;
  for (std::size_t i = 0; i < kDrivenRows; ++i) spindle.put(Channel::kArmatureVoltage, 5.0);
  EXPECT_FALSE(drive_by_current(spindle.signals));
  EXPECT_TRUE(spindle.signals.has_electrics());
  EXPECT_EQ(spindle.signals.value[index_of(Channel::kArmatureVoltage)][7], 5.0F);
}

TEST(CurrentDrive, NeedsASpeed) {
  Spindle spindle;
  spindle.signals.recorded = bit_of(Channel::kArmatureCurrent);
  EXPECT_FALSE(drive_by_current(spindle.signals));
  EXPECT_FALSE(spindle.signals.has(Channel::kArmatureVoltage));
}

}  // namespace
}  // namespace morepro::host
