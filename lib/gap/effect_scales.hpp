#pragma once
#include "lib/gap/effect_signals.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::gap {

/// Constants of the laws, rounded once.
template <class Real>
struct EffectScales {
  Real torque_constant_nm_a = 0;
  Real back_emf_constant_vs_rad = 0;
  Real resistance_ohm = 0;
  Real inductance_h = 0;
  Real inertia_kgm2 = 0;
  Real viscous_friction_nms_rad = 0;
  Real mass_kg = 0;
  Real feed_viscous_friction_ns_m = 0;
  Real contact_load_n = 0;
  Real teeth = 0;
  Real per_screw_turn_rad_m = 0;  ///< 0: pitch unknown
  Real speed_rad_s = 0;
  Real current_a = 0;
  Real feed_speed_m_s = 0;
  Real chip_load_mm = 0;
  Real tool_degc = 0;
  Real winding_degc = 0;
  Real feed_force_n = 1;
  Real travel_from_m = 0;
  Real travel_m = 1;

  EffectScales() = default;
  EffectScales(const MachineParameters& machine, const ReferencePoint& point)
      : torque_constant_nm_a(static_cast<Real>(machine.spindle.torque_constant_nm_a)),
        back_emf_constant_vs_rad(static_cast<Real>(machine.spindle.back_emf_constant_vs_rad)),
        resistance_ohm(static_cast<Real>(machine.spindle.resistance_ohm)),
        inductance_h(static_cast<Real>(machine.spindle.inductance_h)),
        inertia_kgm2(static_cast<Real>(machine.spindle.inertia_kgm2)),
        viscous_friction_nms_rad(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        mass_kg(static_cast<Real>(machine.feed.mass_kg)),
        feed_viscous_friction_ns_m(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        contact_load_n(static_cast<Real>(machine.feed.contact_force_n * machine.feed.engagement +
                                         machine.feed.contact_offset_n)),
        teeth(static_cast<Real>(machine.tool.teeth)),
        per_screw_turn_rad_m(static_cast<Real>(
            machine.feed.screw_pitch_m > 0.0 ? 6.283185307179586 / machine.feed.screw_pitch_m : 0.0)),
        speed_rad_s(static_cast<Real>(point.speed_rad_s)),
        current_a(static_cast<Real>(point.current_a)),
        feed_speed_m_s(static_cast<Real>(point.feed_speed_m_s)),
        chip_load_mm(static_cast<Real>(point.chip_load_mm)),
        tool_degc(static_cast<Real>(point.tool_degc)),
        winding_degc(static_cast<Real>(point.winding_degc)),
        feed_force_n(static_cast<Real>(point.feed_force_n)),
        travel_from_m(static_cast<Real>(point.travel_from_m)),
        travel_m(static_cast<Real>(point.travel_m)) {}
};

}  // namespace morepro::gap
