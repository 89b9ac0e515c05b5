#pragma once
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// A plausible 48 V, 100-500 W spindle with a 10 mm four-flute cutter. The default machine.
constexpr MachineParameters reference_machine() { return MachineParameters{}; }

/// Table 2 of the thesis with corrected units. A numerical benchmark only: it violates energy conservation
/// because its torque constant differs from its back-EMF constant.
constexpr MachineParameters thesis_machine() {
  MachineParameters machine;
  machine.spindle = {.torque_constant_nm_a = 1.5,
                     .back_emf_constant_vs_rad = 0.2,
                     .resistance_ohm = 0.6,
                     .inductance_h = 1.0e-4,
                     .inertia_kgm2 = 1.0e-3,
                     .viscous_friction_nms_rad = 0.3};
  machine.feed = {.mass_kg = 3.0,
                  .contact_force_n = 2.5,
                  .contact_offset_n = 1.0,
                  .engagement = 1.0,
                  .viscous_friction_ns_m = 0.0,
                  .screw_pitch_m = 0.0};
  machine.tool = {.diameter_mm = 100.0, .teeth = 5.0, .chip_load_mm = 0.5};
  machine.contact = {.form = ContactForm::kThesis,
                     .viscous_gain_nms = 1.0,
                     .edge_force_n = 0.0,
                     .chip_force_n_mm = 0.0,
                     .radius_m = 0.0,
                     .speed_scale_rad_s = 1.0};
  return machine;
}

}  // namespace morepro
