#pragma once
#include <cstdint>

namespace morepro {

/// Contact law of the tool. `kConsistent` is dimensionally right; `kThesis` is equation 15 of the thesis,
/// literally.
enum class ContactForm : std::uint8_t { kConsistent = 0, kThesis = 1 };

/// True physics of one machine: what a datasheet says. Double precision everywhere, so that a machine file
/// means the same machine on a board and on a PC; filters round once, at configuration. Symbols of the thesis
/// in brackets; the equations stand in dynamics.hpp and contact_law.hpp.
struct MachineParameters {
  struct Spindle {
    double torque_constant_nm_a = 0.08;        ///< [Kt] > 0
    double back_emf_constant_vs_rad = 0.08;    ///< [Kv] > 0
    double resistance_ohm = 0.8;               ///< [R] > 0
    double inductance_h = 0.5e-3;              ///< [L] > 0
    double inertia_kgm2 = 1.2e-4;              ///< [In] > 0
    double viscous_friction_nms_rad = 1.0e-4;  ///< [Att] >= 0
    double winding_time_constant_s = 0.0;      ///< > 0 where known, 0 = nothing warms it
    double winding_rise_k_a2 = 0.0;            ///< >= 0, of a current that lasts; where no sensor tells
  } spindle;
  struct Feed {
    double mass_kg = 3.0;                  ///< [m] > 0
    double contact_force_n = 20.0;         ///< [F2] >= 0, multiplied by the engagement
    double contact_offset_n = 2.0;         ///< [c] >= 0
    double engagement = 1.0;               ///< [alpha] >= 0, used where a recording has no engagement
    double viscous_friction_ns_m = 200.0;  ///< [bx] >= 0
    double screw_pitch_m = 0.0;            ///< > 0 where known, 0 = unknown
  } feed;
  struct Tool {
    double diameter_mm = 10.0;   ///< [DC] > 0
    double teeth = 4.0;          ///< [t] >= 1, a whole number
    double chip_load_mm = 0.05;  ///< [CL] nominal feed per tooth, > 0
  } tool;
  struct Contact {
    ContactForm form = ContactForm::kConsistent;
    double viscous_gain_nms = 0.0;    ///< [kap] >= 0
    double edge_force_n = 40.0;       ///< [N0] >= 0
    double chip_force_n_mm = 1600.0;  ///< [N1] >= 0
    double radius_m = 5.0e-3;         ///< [r] >= 0
    double speed_scale_rad_s = 1.0;   ///< [ws] > 0
  } contact;
  struct Thermal {
    double reference_degc = 400.0;  ///< [T0]
    double melting_degc = 1400.0;   ///< [Tm] > T0
    double exponent = 0.5535;       ///< [mr] > 0
    double tool_degc = 500.0;       ///< [T] used where a recording has no tool temperature
  } thermal;
};

}  // namespace morepro
