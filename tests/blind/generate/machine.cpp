#include "machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace blind {
namespace {

Machine thesis_machine() {
  Machine m;
  m.is_thesis = true;
  m.torque_constant = 1.5;
  m.back_emf_constant = 0.2;
  m.resistance = 0.6;
  m.inductance = 1e-4;
  m.inertia = 1e-3;
  m.viscous = 0.3;
  m.contact_force = 2.5;
  m.contact_offset = 1.0;
  m.feed_viscous = 0.0;
  m.diameter_mm = 100.0;
  m.teeth = 5.0;
  m.chip_load_mm = 0.5;
  m.viscous_gain = 1.0;
  m.edge_force = m.chip_force = m.radius = 0.0;
  m.voltage_limit = 100.0;
  m.speed.noise = 0.5;
  m.current.noise = 0.1;
  return m;
}

void give_steps(Machine& m, Random& random) {
  for (Sensor* sensor : {&m.speed, &m.feed, &m.current, &m.position}) {
    sensor->noise *= random.uniform(0.8, 1.25);
    if (random.chance(0.3)) sensor->lsb = sensor->noise * random.uniform(0.5, 2.0);
  }
}

std::string line(const char* key, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%s = %.9g\n", key, value);
  return text;
}

std::string sensor_table(const char* column, const Sensor& sensor) {
  return std::string("\n[sensors.") + column + "]\n" + line("noise", sensor.noise) + line("lsb", sensor.lsb);
}

std::string spindle_and_feed(const Machine& m) {
  std::string text = "[spindle]\n" + line("torque_constant_nm_a", m.torque_constant) +
                     line("back_emf_constant_vs_rad", m.back_emf_constant) +
                     line("resistance_ohm", m.resistance) + line("inductance_h", m.inductance) +
                     line("inertia_kgm2", m.inertia) + line("viscous_friction_nms_rad", m.viscous) +
                     "\n[feed]\n" + line("mass_kg", m.mass) + line("contact_force_n", m.contact_force) +
                     line("contact_offset_n", m.contact_offset) + line("engagement", m.engagement) +
                     line("screw_pitch_m", m.screw_pitch);
  if (m.feed_viscous > 0.0) text += line("viscous_friction_ns_m", m.feed_viscous);
  return text;
}

std::string tool_and_contact(const Machine& m, double sample_s) {
  return "\n[tool]\n" + line("diameter_mm", m.diameter_mm) +
         "teeth = " + std::to_string(static_cast<int>(m.teeth)) + "\n" +
         line("chip_load_mm", m.chip_load_mm) + "\n[contact]\nform = \"" +
         (m.is_thesis ? "thesis" : "consistent") + "\"\n" + line("viscous_gain_nms", m.viscous_gain) +
         line("edge_force_n", m.edge_force) + line("chip_force_n_mm", m.chip_force) +
         line("radius_m", m.radius) + line("speed_scale_rad_s", m.speed_scale) + "\n[thermal]\n" +
         line("reference_degc", m.reference_c) + line("melting_degc", m.melting_c) +
         line("exponent", m.exponent) + "\n[sampling]\n" + line("rate_hz", 1.0 / sample_s);
}

}  // namespace

double Machine::working_speed() const {
  const double cutting_friction = is_thesis ? 0.45 : 0.0;
  const double volts_per_speed =
      resistance * (viscous + cutting_friction) / torque_constant + back_emf_constant;
  return std::min(is_thesis ? 180.0 : 600.0, 0.75 * voltage_limit / volts_per_speed);
}

Machine random_machine(Random& random, bool is_thesis) {
  Machine m = is_thesis ? thesis_machine() : Machine{};
  const double flux = random.log_uniform(0.7, 1.4);
  m.torque_constant *= flux;
  m.back_emf_constant *= flux;
  for (double* value : {&m.resistance, &m.inductance, &m.inertia, &m.viscous, &m.mass, &m.contact_force,
                        &m.contact_offset, &m.feed_viscous, &m.edge_force, &m.chip_force})
    *value *= random.log_uniform(0.65, 1.4);
  m.screw_pitch = random.chance(0.5) ? 0.005 : 0.01;
  give_steps(m, random);
  return m;
}

Machine datasheet_of(const Machine& machine, double largest_error, Random& random) {
  Machine sheet = machine;
  const double flux_error = random.uniform(-largest_error, largest_error);
  sheet.torque_constant *= 1.0 + flux_error;
  sheet.back_emf_constant *=
      1.0 + (random.chance(0.5) ? flux_error : random.uniform(-largest_error, largest_error));
  for (double* value : {&sheet.resistance, &sheet.inductance, &sheet.inertia, &sheet.viscous, &sheet.mass,
                        &sheet.contact_force, &sheet.contact_offset, &sheet.feed_viscous})
    *value *= 1.0 + random.uniform(-largest_error, largest_error);
  return sheet;
}

std::string machine_toml(const Machine& m, const std::string& name, double sample_s, bool has_position,
                         bool has_angle) {
  std::string text = "[machine]\nname = \"" + name + "\"\n\n" + spindle_and_feed(m) +
                     tool_and_contact(m, sample_s) + sensor_table("spindle_speed_rad_s", m.speed) +
                     sensor_table("feed_speed_m_s", m.feed) + sensor_table("armature_current_a", m.current) +
                     sensor_table("tool_temperature_degc", m.tool) +
                     sensor_table("winding_temperature_degc", m.winding);
  if (has_position) text += sensor_table("feed_position_m", m.position);
  if (has_angle) text += sensor_table("spindle_angle_rad", m.angle);
  return text;
}

double heat_factor(const Machine& m, double tool_c) {
  const double softening = std::clamp((tool_c - m.reference_c) / (m.melting_c - m.reference_c), 0.0, 1.0);
  return softening > 0.0 ? 1.0 - std::pow(softening, m.exponent) : 1.0;
}

double contact_torque(const Machine& m, double speed, double chip_load, double heat) {
  const double magnitude = std::abs(speed);
  if (m.is_thesis) {
    const double floored = std::max(magnitude, m.speed_scale);
    const double surface = 3.141592653589793 * m.diameter_mm * floored / 1000.0;
    const double beta = 3.32 * std::pow(surface, -0.45) - 0.24 * m.teeth * floored * chip_load * 1e-3;
    return std::max(0.0, beta * heat) * m.viscous_gain * speed;
  }
  const double cutting_m_min = std::clamp(0.03 * m.diameter_mm * magnitude, 70.0, 230.0);
  const double feed_mm_rev = std::clamp(m.teeth * chip_load, 0.08, 0.47);
  const double beta = std::max(0.0, (3.32 * std::pow(cutting_m_min, -0.45) - 0.24 * feed_mm_rev) * heat);
  const double normal_force = m.edge_force + m.chip_force * chip_load;
  return beta * (m.viscous_gain * speed + normal_force * m.radius * std::tanh(speed / m.speed_scale));
}

}  // namespace blind
