#pragma once
#include "lib/c/morepro_machine.h"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::c {

template <class From, class To>
constexpr void set(const From& from, To& to) {
  to = static_cast<To>(from);
}

/// Between a machine of C and one of C++, in either direction: the fields of both have the same names.
template <class From, class To>
constexpr void copy_machine(const From& from, To& to) {
  to.spindle.torque_constant_nm_a = from.spindle.torque_constant_nm_a;
  to.spindle.back_emf_constant_vs_rad = from.spindle.back_emf_constant_vs_rad;
  to.spindle.resistance_ohm = from.spindle.resistance_ohm;
  to.spindle.inductance_h = from.spindle.inductance_h;
  to.spindle.inertia_kgm2 = from.spindle.inertia_kgm2;
  to.spindle.viscous_friction_nms_rad = from.spindle.viscous_friction_nms_rad;
  to.spindle.winding_time_constant_s = from.spindle.winding_time_constant_s;
  to.spindle.winding_rise_k_a2 = from.spindle.winding_rise_k_a2;
  to.feed.mass_kg = from.feed.mass_kg;
  to.feed.contact_force_n = from.feed.contact_force_n;
  to.feed.contact_offset_n = from.feed.contact_offset_n;
  to.feed.engagement = from.feed.engagement;
  to.feed.viscous_friction_ns_m = from.feed.viscous_friction_ns_m;
  to.feed.screw_pitch_m = from.feed.screw_pitch_m;
  to.tool.diameter_mm = from.tool.diameter_mm;
  to.tool.teeth = from.tool.teeth;
  to.tool.chip_load_mm = from.tool.chip_load_mm;
  set(from.contact.form, to.contact.form);
  to.contact.viscous_gain_nms = from.contact.viscous_gain_nms;
  to.contact.edge_force_n = from.contact.edge_force_n;
  to.contact.chip_force_n_mm = from.contact.chip_force_n_mm;
  to.contact.radius_m = from.contact.radius_m;
  to.contact.speed_scale_rad_s = from.contact.speed_scale_rad_s;
  to.thermal.reference_degc = from.thermal.reference_degc;
  to.thermal.melting_degc = from.thermal.melting_degc;
  to.thermal.exponent = from.thermal.exponent;
  to.thermal.tool_degc = from.thermal.tool_degc;
}

constexpr MachineParameters to_cpp(const morepro_machine& machine) {
  MachineParameters to;
  copy_machine(machine, to);
  return to;
}

constexpr morepro_machine to_c(const MachineParameters& machine) {
  morepro_machine to{};
  copy_machine(machine, to);
  return to;
}

/// Is the contact law one of those that there are?
constexpr bool is_known_form(const morepro_machine& machine) {
  return machine.contact.form <= MOREPRO_CONTACT_THESIS;
}

}  // namespace morepro::c
