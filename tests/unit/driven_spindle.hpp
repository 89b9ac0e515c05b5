#pragma once
#include <cmath>
#include <functional>
#include <iterator>
#include <random>

#include "lib/plant/contact_law.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {

/// State of a spindle that is integrated here, not by the simulated machine.
struct SpindleState {
  double speed_rad_s = 0.0;
  double current_a = 0.0;
  double angle_rad = 0.0;
};

/// A spindle that cuts while it turns either way: what brakes it beside its datasheet is the test's.
struct DrivenSpindle {
  double rate_hz = 10000.0;
  std::size_t rows = 40000;
  /// Against positive speed, in N m; `contact`: 0 or 1.
  std::function<double(const SpindleState&, double contact)> brake_at = [](const SpindleState&, double) {
    return 0.0;
  };
  /// That nobody knows of, against positive speed, in N m at a time in s; the same in all of an interval.
  std::function<double(double)> load_at = [](double) { return 0.0; };
  /// Share of the datasheet's inductance at an angle in rad.
  std::function<double(double)> inductance_at = [](double) { return 1.0; };
  /// Share of the datasheet's resistance at a time in s.
  std::function<double(double)> resistance_at = [](double) { return 1.0; };
  /// Share of the datasheet's inertia at a time in s.
  std::function<double(double)> inertia_at = [](double) { return 1.0; };
  bool shows_angle = false;
  bool cuts = true;  ///< else it turns in the air, and nobody records a contact
};

/// Both ways at several speeds, shaken.
inline double driving_v(double time_s) {
  constexpr double kStepS = 0.35;
  constexpr double kVolts[] = {40.0, -36.0, 20.0, -45.0, 30.0, -14.0};
  const auto step = static_cast<std::size_t>(time_s / kStepS);
  return kVolts[step % std::size(kVolts)] + 2.0 * std::sin(410.0 * time_s) + 2.0 * std::sin(1700.0 * time_s);
}

inline RecordingSignals record(const DrivenSpindle& spindle) {
  constexpr int kSteps = 50;
  const double step_s = 1.0 / (spindle.rate_hz * kSteps);
  const MonitorConfiguration configuration = reference_configuration();
  const auto& motor = configuration.machine.spindle;
  const ContactLaw<double> cut(configuration.machine);
  const double chip_load_mm = configuration.machine.tool.chip_load_mm;
  const double tool_degc = configuration.machine.thermal.reference_degc;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = spindle.rate_hz;
  signals.rows = spindle.rows;
  const auto show_noisy = [&](Channel channel, double value) {
    show(signals, channel, value + configuration.sensors[channel].noise * normal(random));
  };
  SpindleState x;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double time_s = signals.time_s(row);
    const double voltage_v = driving_v(time_s);
    const double contact = spindle.cuts && std::fmod(time_s, 0.25) < 0.15 ? 1.0 : 0.0;
    show(signals, Channel::kArmatureVoltage, voltage_v);
    if (spindle.cuts) show(signals, Channel::kContact, contact);
    if (spindle.cuts) show(signals, Channel::kToolTemperature, tool_degc);
    show_noisy(Channel::kSpindleSpeed, x.speed_rad_s);
    show_noisy(Channel::kArmatureCurrent, x.current_a);
    if (spindle.shows_angle) show(signals, Channel::kSpindleAngle, x.angle_rad);
    const double resistance_ohm = motor.resistance_ohm * spindle.resistance_at(time_s);
    const double inertia_kgm2 = motor.inertia_kgm2 * spindle.inertia_at(time_s);
    const double load_nm = spindle.load_at(time_s);
    for (int step = 0; step < kSteps; ++step) {
      const double cut_nm = contact * cut(x.speed_rad_s, chip_load_mm, tool_degc).torque_nm;
      const double left_nm = motor.torque_constant_nm_a * x.current_a -
                             motor.viscous_friction_nms_rad * x.speed_rad_s - cut_nm - load_nm -
                             spindle.brake_at(x, contact);
      const double left_v =
          voltage_v - resistance_ohm * x.current_a - motor.back_emf_constant_vs_rad * x.speed_rad_s;
      x.angle_rad += step_s * x.speed_rad_s;
      x.speed_rad_s += step_s * left_nm / inertia_kgm2;
      x.current_a += step_s * left_v / (motor.inductance_h * spindle.inductance_at(x.angle_rad));
    }
  }
  host::count_cutting_time(signals);
  return signals;
}

}  // namespace morepro::diagnose_test
