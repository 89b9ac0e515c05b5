#include "sim_host/simulate/operating_point.hpp"

#include <cmath>
#include <numbers>

#include "lib/plant/contact_law.hpp"

namespace morepro::host {
namespace {

// Inside the contact law's 70 .. 230 m/min; the reference machine reaches it at 48 V.
constexpr double kCuttingSpeedMMin = 173.3;
// The thesis machine at 48 V in contact: 93.6 rad/s with its 100 mm cutter.
constexpr double kThesisSpeedMmRadS = 9360.0;

// Of small milling machines, where a machine file does not say.
constexpr double kUsualFeedMS = 0.02;
constexpr double kUsualChipLoadMm = 0.05;

double operating_speed(const MachineParameters& machine) {
  if (machine.contact.form == ContactForm::kThesis) return kThesisSpeedMmRadS / machine.tool.diameter_mm;
  return kCuttingSpeedMMin / (0.03 * machine.tool.diameter_mm);
}

double changed_chip_load(const MachineParameters& machine) {
  const bool is_thesis = machine.contact.form == ContactForm::kThesis;
  const double less_mm = (is_thesis ? 0.6 : 0.8) * machine.tool.chip_load_mm;
  return is_inside_contact_range(machine, less_mm) ? less_mm : 1.2 * machine.tool.chip_load_mm;
}

bool is_usable(double value) { return value > 0.0 && std::isfinite(value); }

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

gap::ReferencePoint reference_point_of(const MachineParameters& machine) {
  constexpr double kHalfOfSupplyV = 24.0;
  constexpr double kHighestSupplyV = 1000.0;
  const auto& spindle = machine.spindle;
  const OperatingPoint cut = operating_point_of(machine);
  const bool has_cut =
      is_usable(cut.speed_rad_s) && is_usable(cut.voltage_v) && cut.voltage_v < kHighestSupplyV;
  const double cut_a =
      (cut.voltage_v - spindle.back_emf_constant_vs_rad * cut.speed_rad_s) / spindle.resistance_ohm;
  gap::ReferencePoint point;
  point.speed_rad_s = has_cut ? cut.speed_rad_s : kHalfOfSupplyV / spindle.back_emf_constant_vs_rad;
  point.current_a = has_cut && is_usable(cut_a) ? cut_a : 0.1 * kHalfOfSupplyV / spindle.resistance_ohm;
  point.feed_speed_m_s = has_cut && is_usable(cut.feed_speed_m_s) ? cut.feed_speed_m_s : kUsualFeedMS;
  point.chip_load_mm = is_usable(cut.chip_load_mm) ? cut.chip_load_mm : kUsualChipLoadMm;
  point.tool_degc = machine.thermal.tool_degc;
  return point;
}

}  // namespace morepro::host
