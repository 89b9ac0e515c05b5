#pragma once
#include "lib/gap/effect_signals.hpp"
#include "lib/plant/contact_law.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::gap {

/// The cut that a machine is made for, at a constant speed.
struct SteadyCut {
  double speed_rad_s = 0.0;
  double voltage_v = 0.0;       ///< holds the speed in contact, at the nominal chip load
  double feed_speed_m_s = 0.0;  ///< gives the nominal chip load at that speed
  double chip_load_mm = 0.0;
};

/// Feed speed in m/s at which every tooth takes `chip_load_mm`.
inline double feed_speed_for(const MachineParameters& machine, double speed_rad_s, double chip_load_mm) {
  constexpr double kTurnRad = 6.283185307179586;
  return 1.0e-3 * chip_load_mm * machine.tool.teeth * (speed_rad_s / kTurnRad);
}

inline SteadyCut steady_cut_of(const MachineParameters& machine) {
  // Inside the contact law's 70 .. 230 m/min; the reference machine reaches it at 48 V.
  constexpr double kCuttingSpeedMMin = 173.3;
  // The thesis machine at 48 V in contact: 93.6 rad/s with its 100 mm cutter.
  constexpr double kThesisSpeedMmRadS = 9360.0;
  const auto& spindle = machine.spindle;
  SteadyCut cut;
  cut.speed_rad_s = machine.contact.form == ContactForm::kThesis
                        ? kThesisSpeedMmRadS / machine.tool.diameter_mm
                        : kCuttingSpeedMMin / (0.03 * machine.tool.diameter_mm);
  cut.chip_load_mm = machine.tool.chip_load_mm;
  cut.feed_speed_m_s = feed_speed_for(machine, cut.speed_rad_s, cut.chip_load_mm);
  // In float, as everywhere on the board: its powers are the same bits on every machine.
  const float load_nm =
      ContactLaw<float>(machine)(static_cast<float>(cut.speed_rad_s), static_cast<float>(cut.chip_load_mm),
                                 static_cast<float>(machine.thermal.tool_degc))
          .torque_nm;
  const double current_a =
      (spindle.viscous_friction_nms_rad * cut.speed_rad_s + static_cast<double>(load_nm)) /
      spindle.torque_constant_nm_a;
  cut.voltage_v = spindle.resistance_ohm * current_a + spindle.back_emf_constant_vs_rad * cut.speed_rad_s;
  return cut;
}

/// Where effects are normalised: the steady cut, with the winding at the temperature of its datasheet. A
/// machine without a cut that 1000 V reach gets its speed at 24 V without load, and a tenth of its current at
/// 24 V and standstill. Speeds, current and chip load are > 0. For the time of configuration; the same bits
/// on a board as on a PC.
inline ReferencePoint reference_point_of(const MachineParameters& machine) {
  constexpr double kHalfOfSupplyV = 24.0;
  constexpr double kHighestSupplyV = 1000.0;
  // Of small milling machines, where a machine file does not say.
  constexpr double kUsualFeedMS = 0.02;
  constexpr double kUsualChipLoadMm = 0.05;
  const auto is_usable = [](double value) { return value > 0.0 && value - value == 0.0; };
  const auto& spindle = machine.spindle;
  const SteadyCut cut = steady_cut_of(machine);
  const bool has_cut =
      is_usable(cut.speed_rad_s) && is_usable(cut.voltage_v) && cut.voltage_v < kHighestSupplyV;
  const double cut_a =
      (cut.voltage_v - spindle.back_emf_constant_vs_rad * cut.speed_rad_s) / spindle.resistance_ohm;
  ReferencePoint point;
  point.speed_rad_s = has_cut ? cut.speed_rad_s : kHalfOfSupplyV / spindle.back_emf_constant_vs_rad;
  point.current_a = has_cut && is_usable(cut_a) ? cut_a : 0.1 * kHalfOfSupplyV / spindle.resistance_ohm;
  point.feed_speed_m_s = has_cut && is_usable(cut.feed_speed_m_s) ? cut.feed_speed_m_s : kUsualFeedMS;
  point.chip_load_mm = is_usable(cut.chip_load_mm) ? cut.chip_load_mm : kUsualChipLoadMm;
  point.tool_degc = machine.thermal.tool_degc;
  return point;
}

}  // namespace morepro::gap
