#include "sim_host/simulate/operating_point.hpp"

#include <numbers>

#include "lib/plant/contact_law.hpp"

namespace morepro::host {
namespace {

// Inside the contact law's 70 .. 230 m/min; the reference machine reaches it at 48 V.
constexpr double kCuttingSpeedMMin = 173.3;
// The thesis machine at 48 V in contact: 93.6 rad/s with its 100 mm cutter.
constexpr double kThesisSpeedMmRadS = 9360.0;

double operating_speed(const MachineParameters& machine) {
  if (machine.contact.form == ContactForm::kThesis) return kThesisSpeedMmRadS / machine.tool.diameter_mm;
  return kCuttingSpeedMMin / (0.03 * machine.tool.diameter_mm);
}

double changed_chip_load(const MachineParameters& machine) {
  const bool is_thesis = machine.contact.form == ContactForm::kThesis;
  const double less_mm = (is_thesis ? 0.6 : 0.8) * machine.tool.chip_load_mm;
  return is_inside_contact_range(machine, less_mm) ? less_mm : 1.2 * machine.tool.chip_load_mm;
}

}  // namespace

double feed_speed_for(const MachineParameters& machine, double speed_rad_s, double chip_load_mm) {
  const double revolutions_s = speed_rad_s / (2.0 * std::numbers::pi);
  return 1.0e-3 * chip_load_mm * machine.tool.teeth * revolutions_s;
}

OperatingPoint operating_point_of(const MachineParameters& machine) {
  OperatingPoint point;
  point.speed_rad_s = operating_speed(machine);
  point.chip_load_mm = machine.tool.chip_load_mm;
  point.other_chip_load_mm = changed_chip_load(machine);
  point.feed_speed_m_s = feed_speed_for(machine, point.speed_rad_s, point.chip_load_mm);
  const auto& spindle = machine.spindle;
  const double cut_nm =
      ContactLaw<double>(machine)(point.speed_rad_s, point.chip_load_mm, machine.thermal.tool_degc).torque_nm;
  const double current_a =
      (spindle.viscous_friction_nms_rad * point.speed_rad_s + cut_nm) / spindle.torque_constant_nm_a;
  point.voltage_v = spindle.resistance_ohm * current_a + spindle.back_emf_constant_vs_rad * point.speed_rad_s;
  return point;
}

}  // namespace morepro::host
