#pragma once
#include <string>

#include "random.hpp"

namespace blind {

/// Standard deviation and step of one sensor, in the unit of its column.
struct Sensor {
  double noise = 0.0;
  double lsb = 0.0;
};

/// True machine, or its datasheet. Units as in the machine file.
struct Machine {
  bool is_thesis = false;
  double torque_constant = 0.08, back_emf_constant = 0.08, resistance = 0.8, inductance = 5e-4;
  double inertia = 1.2e-4, viscous = 1e-4;
  double mass = 3.0, contact_force = 20.0, contact_offset = 2.0, engagement = 1.0, feed_viscous = 200.0;
  double screw_pitch = 0.005;
  double diameter_mm = 10.0, teeth = 4.0, chip_load_mm = 0.05;
  double viscous_gain = 0.0, edge_force = 40.0, chip_force = 1600.0, radius = 0.005, speed_scale = 1.0;
  double reference_c = 400.0, melting_c = 1400.0, exponent = 0.5535;
  double voltage_limit = 60.0;
  Sensor speed{1.0, 0.0}, feed{0.002, 0.0}, position{1e-6, 0.0}, current{0.05, 0.0};
  Sensor tool{0.5, 0.0}, winding{0.5, 0.0}, angle{0.001, 0.0};

  /// Speed that production runs at, rad/s.
  double working_speed() const;
  /// Current of a typical cut, A.
  double working_current() const { return is_thesis ? 40.0 : 2.5; }
};

/// Another individual of the reference or thesis machine: physical values differ by up to 40 %.
Machine random_machine(Random& random, bool is_thesis);

/// The datasheet of a machine: its values in [spindle] and [feed] are off by up to `largest_error`.
Machine datasheet_of(const Machine& machine, double largest_error, Random& random);

/// Machine file; `has_position` and `has_angle` say which optional columns the recording holds.
std::string machine_toml(const Machine& datasheet, const std::string& name, double sample_s,
                         bool has_position, bool has_angle);

/// Torque of the contact at full contact, N m, with the sign of the speed.
double contact_torque(const Machine& machine, double speed_rad_s, double chip_load_mm, double heat_factor);

/// 1 up to the reference temperature, 0 at melting.
double heat_factor(const Machine& machine, double tool_c);

}  // namespace blind
