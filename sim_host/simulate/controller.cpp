#include "sim_host/simulate/controller.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {

double PiController::step(double error, double feedforward, double step_s) {
  const double wanted = feedforward + gains_.proportional * error + integral_;
  const double output = std::clamp(wanted, -gains_.limit, gains_.limit);
  if (output == wanted) integral_ += gains_.integral_per_s * error * step_s;
  return output;
}

// The armature's lag is an order faster than the loop: the spindle is a first-order lag from voltage to
// speed, and the controller's zero cancels it.
PiController speed_controller(const MachineParameters& machine, double limit_v) {
  constexpr double kBandwidthRadS = 40.0;
  const auto& s = machine.spindle;
  const double damping =
      s.torque_constant_nm_a * s.back_emf_constant_vs_rad + s.resistance_ohm * s.viscous_friction_nms_rad;
  const double rad_s_per_volt = s.torque_constant_nm_a / damping;
  const double lag_s = s.inertia_kgm2 * s.resistance_ohm / damping;
  return PiController({.proportional = kBandwidthRadS * lag_s / rad_s_per_volt,
                       .integral_per_s = kBandwidthRadS / rad_s_per_volt,
                       .limit = limit_v});
}

PiController feed_controller(const MachineParameters& machine) {
  constexpr double kBandwidthRadS = 30.0;
  constexpr double kLargestAccelerationMS2 = 100.0;
  const auto& f = machine.feed;
  const double critical = 2.0 * kBandwidthRadS * f.mass_kg;
  return PiController({.proportional = std::max(critical - f.viscous_friction_ns_m, 0.1 * critical),
                       .integral_per_s = kBandwidthRadS * kBandwidthRadS * f.mass_kg,
                       .limit = kLargestAccelerationMS2 * f.mass_kg});
}

}  // namespace morepro::host
