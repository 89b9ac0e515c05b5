#include "sim_host/identify/machine_value.hpp"

#include "sim_host/replay/names.hpp"

namespace morepro::host {

std::string_view name_of(MachineValue value) {
  if (value == MachineValue::kSpindleFriction) return "viscous_friction_nms_rad";
  if (value == MachineValue::kFeedFriction) return "viscous_friction_ns_m";
  return name_of(static_cast<Parameter>(value));
}

const char* excitation_for(MachineValue value) {
  switch (value) {
    case MachineValue::kTorqueConstant:
      return "currents under a known load, such as contact on and off";
    case MachineValue::kInertia:
      return "speeds that change, such as steps of the voltage";
    case MachineValue::kMass:
      return "steps of the feed force";
    case MachineValue::kContactForce:
      return "contact on and off";
    case MachineValue::kInductance:
      return "steps of the voltage, sampled several times within L/R";
    case MachineValue::kResistance:
      return "currents that vary apart from the speed, such as contact on and off";
    case MachineValue::kBackEmfConstant:
      return "speeds that vary apart from the current, such as contact on and off";
    case MachineValue::kSpindleFriction:
      return "several speeds, in the air and in the cut";
    case MachineValue::kFeedFriction:
      return "several feed speeds";
  }
  return "";
}

double& value_in(MachineParameters& machine, MachineValue value) {
  switch (value) {
    case MachineValue::kTorqueConstant:
      return machine.spindle.torque_constant_nm_a;
    case MachineValue::kInertia:
      return machine.spindle.inertia_kgm2;
    case MachineValue::kMass:
      return machine.feed.mass_kg;
    case MachineValue::kContactForce:
      return machine.feed.contact_force_n;
    case MachineValue::kInductance:
      return machine.spindle.inductance_h;
    case MachineValue::kResistance:
      return machine.spindle.resistance_ohm;
    case MachineValue::kBackEmfConstant:
      return machine.spindle.back_emf_constant_vs_rad;
    case MachineValue::kSpindleFriction:
      return machine.spindle.viscous_friction_nms_rad;
    case MachineValue::kFeedFriction:
      break;
  }
  return machine.feed.viscous_friction_ns_m;
}

double value_in(const MachineParameters& machine, MachineValue value) {
  MachineParameters copy = machine;
  return value_in(copy, value);
}

}  // namespace morepro::host
