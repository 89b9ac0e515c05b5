#include "sim_host/machine/machine_key.hpp"

#include <fmt/format.h>

#include <array>

namespace morepro::host {
namespace {

using Machine = MachineParameters;
using Needed = MachineKey::Needed;
using Range = MachineKey::Range;

constexpr std::array kMachineKeys{
    MachineKey{"spindle", "torque_constant_nm_a",
               [](Machine& m) -> double& { return m.spindle.torque_constant_nm_a; }},
    MachineKey{"spindle", "back_emf_constant_vs_rad",
               [](Machine& m) -> double& { return m.spindle.back_emf_constant_vs_rad; }},
    MachineKey{"spindle", "resistance_ohm", [](Machine& m) -> double& { return m.spindle.resistance_ohm; }},
    MachineKey{"spindle", "inductance_h", [](Machine& m) -> double& { return m.spindle.inductance_h; }},
    MachineKey{"spindle", "inertia_kgm2", [](Machine& m) -> double& { return m.spindle.inertia_kgm2; }},
    MachineKey{"spindle", "viscous_friction_nms_rad",
               [](Machine& m) -> double& { return m.spindle.viscous_friction_nms_rad; }, Needed::kNever,
               Range::kNotNegative},
    MachineKey{"spindle", "winding_time_constant_s",
               [](Machine& m) -> double& { return m.spindle.winding_time_constant_s; }, Needed::kNever,
               Range::kNotNegative},
    MachineKey{"spindle", "winding_rise_k_a2",
               [](Machine& m) -> double& { return m.spindle.winding_rise_k_a2; }, Needed::kNever,
               Range::kNotNegative},
    MachineKey{"feed", "mass_kg", [](Machine& m) -> double& { return m.feed.mass_kg; }},
    MachineKey{"feed", "contact_force_n", [](Machine& m) -> double& { return m.feed.contact_force_n; },
               Needed::kNever, Range::kNotNegative},
    MachineKey{"feed", "contact_offset_n", [](Machine& m) -> double& { return m.feed.contact_offset_n; },
               Needed::kNever, Range::kNotNegative},
    MachineKey{"feed", "engagement", [](Machine& m) -> double& { return m.feed.engagement; }, Needed::kNever,
               Range::kNotNegative, 1.0},
    MachineKey{"feed", "viscous_friction_ns_m",
               [](Machine& m) -> double& { return m.feed.viscous_friction_ns_m; }, Needed::kNever,
               Range::kNotNegative},
    MachineKey{"feed", "screw_pitch_m", [](Machine& m) -> double& { return m.feed.screw_pitch_m; },
               Needed::kNever, Range::kNotNegative},
    MachineKey{"tool", "diameter_mm", [](Machine& m) -> double& { return m.tool.diameter_mm; }},
    MachineKey{"tool", "teeth", [](Machine& m) -> double& { return m.tool.teeth; }},
    MachineKey{"tool", "chip_load_mm", [](Machine& m) -> double& { return m.tool.chip_load_mm; }},
    MachineKey{"contact", "viscous_gain_nms",
               [](Machine& m) -> double& { return m.contact.viscous_gain_nms; }, Needed::kByThesisForm,
               Range::kNotNegative},
    MachineKey{"contact", "edge_force_n", [](Machine& m) -> double& { return m.contact.edge_force_n; },
               Needed::kByConsistentForm, Range::kNotNegative},
    MachineKey{"contact", "chip_force_n_mm", [](Machine& m) -> double& { return m.contact.chip_force_n_mm; },
               Needed::kByConsistentForm, Range::kNotNegative},
    MachineKey{"contact", "radius_m", [](Machine& m) -> double& { return m.contact.radius_m; },
               Needed::kByConsistentForm, Range::kNotNegative},
    MachineKey{"contact", "speed_scale_rad_s",
               [](Machine& m) -> double& { return m.contact.speed_scale_rad_s; }, Needed::kNever,
               Range::kPositive, 1.0},
    MachineKey{"thermal", "reference_degc", [](Machine& m) -> double& { return m.thermal.reference_degc; },
               Needed::kAlways, Range::kAnyFinite, 1000.0},
    MachineKey{"thermal", "melting_degc", [](Machine& m) -> double& { return m.thermal.melting_degc; },
               Needed::kAlways, Range::kAnyFinite, 2000.0},
    MachineKey{"thermal", "exponent", [](Machine& m) -> double& { return m.thermal.exponent; },
               Needed::kAlways, Range::kPositive, 1.0},
    MachineKey{"thermal", "tool_degc", [](Machine& m) -> double& { return m.thermal.tool_degc; },
               Needed::kNever, Range::kAnyFinite, 500.0},
};

}  // namespace

std::span<const MachineKey> machine_keys() { return kMachineKeys; }

std::string full_name(const MachineKey& key) { return fmt::format("{}.{}", key.table, key.key); }

void set_neutral(std::string_view table, MachineParameters& machine) {
  for (const MachineKey& key : kMachineKeys) {
    if (key.table == table) key.of(machine) = key.neutral;
  }
}

}  // namespace morepro::host
