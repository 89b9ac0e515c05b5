#ifndef MOREPRO_MACHINE_H
#define MOREPRO_MACHINE_H
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  MOREPRO_CONTACT_CONSISTENT = 0,  ///< dimensionally right
  MOREPRO_CONTACT_THESIS = 1       ///< equation 15 of the thesis, literally
};

/// True physics of one machine: what a datasheet says. Symbols of the thesis in brackets. Values beyond 1e9,
/// and those above 0 but below 1e-12, are refused as mistakes of units.
typedef struct morepro_machine {
  struct {
    double torque_constant_nm_a;      ///< [Kt] > 0
    double back_emf_constant_vs_rad;  ///< [Kv] > 0
    double resistance_ohm;            ///< [R] > 0
    double inductance_h;              ///< [L] > 0
    double inertia_kgm2;              ///< [In] > 0
    double viscous_friction_nms_rad;  ///< [Att] >= 0
    double winding_time_constant_s;   ///< > 0 where known, 0 = nothing warms it
    double winding_rise_k_a2;         ///< >= 0, of a current that lasts; where no sensor tells
  } spindle;
  struct {
    double mass_kg;                ///< [m] > 0
    double contact_force_n;        ///< [F2] >= 0, multiplied by the engagement
    double contact_offset_n;       ///< [c] >= 0
    double engagement;             ///< [alpha] >= 0, used where frames have no engagement
    double viscous_friction_ns_m;  ///< [bx] >= 0
    double screw_pitch_m;          ///< > 0 where known, 0 = unknown
  } feed;
  struct {
    double diameter_mm;   ///< [DC] > 0
    double teeth;         ///< [t] > 0, a whole number
    double chip_load_mm;  ///< [CL] nominal feed per tooth, > 0
  } tool;
  struct {
    uint8_t form;              ///< MOREPRO_CONTACT_...
    double viscous_gain_nms;   ///< [kap] >= 0
    double edge_force_n;       ///< [N0] >= 0
    double chip_force_n_mm;    ///< [N1] >= 0
    double radius_m;           ///< [r] >= 0
    double speed_scale_rad_s;  ///< [ws] > 0
  } contact;
  struct {
    double reference_degc;  ///< [T0]
    double melting_degc;    ///< [Tm] > T0
    double exponent;        ///< [mr] > 0
    double tool_degc;       ///< [T] used where frames have no tool temperature
  } thermal;
} morepro_machine;

/// A plausible 48 V, 100-500 W spindle with a 10 mm four-flute cutter.
morepro_machine morepro_reference_machine(void);

/// Table 2 of the thesis with corrected units. A numerical benchmark only: its torque constant differs from
/// its back-EMF constant, so it violates energy conservation.
morepro_machine morepro_thesis_machine(void);

#ifdef __cplusplus
}
#endif

#endif
