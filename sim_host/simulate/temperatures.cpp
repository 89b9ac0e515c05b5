#include "sim_host/simulate/temperatures.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {
namespace {

constexpr double kAmbientDegc = 25.0;
constexpr double kWindingTimeS = 5.0;
// With contact half of the time the tool stays well above the reference machine's 400 degC, where the contact
// law has a kink.
constexpr double kToolHeatingTimeS = 2.0;
constexpr double kToolCoolingTimeS = 40.0;
constexpr double kRatedRiseK = 60.0;
// What a motor stands for ever: the current of 6 V at standstill, or that of its cut where it is more.
constexpr double kRatedVoltageV = 6.0;

double rated_current(const MachineParameters& machine, const gap::ReferencePoint& point) {
  return std::max(point.current_a, kRatedVoltageV / machine.spindle.resistance_ohm);
}

double winding_time_s(const MachineParameters::Spindle& spindle) {
  return spindle.winding_time_constant_s > 0.0 ? spindle.winding_time_constant_s : kWindingTimeS;
}

double winding_rise_k_a2(const MachineParameters& machine, const gap::ReferencePoint& point) {
  if (machine.spindle.winding_rise_k_a2 > 0.0) return machine.spindle.winding_rise_k_a2;
  return kRatedRiseK / std::pow(rated_current(machine, point), 2);
}

}  // namespace

Temperatures::Temperatures(const MachineParameters& machine, const gap::ReferencePoint& point, double step_s)
    : winding_share_(1.0 - std::exp(-step_s / winding_time_s(machine.spindle))),
      heating_share_(1.0 - std::exp(-step_s / kToolHeatingTimeS)),
      cooling_share_(1.0 - std::exp(-step_s / kToolCoolingTimeS)),
      winding_k_per_a2_(winding_rise_k_a2(machine, point)),
      nominal_tool_degc_(machine.thermal.tool_degc),
      tool_degc_(nominal_tool_degc_),
      winding_degc_(kAmbientDegc) {}

void Temperatures::step(double mean_square_current_a2, double contact) {
  const double winding_end_degc = kAmbientDegc + winding_k_per_a2_ * mean_square_current_a2;
  winding_degc_ += winding_share_ * (winding_end_degc - winding_degc_);
  tool_degc_ += contact * heating_share_ * (nominal_tool_degc_ - tool_degc_) +
                (1.0 - contact) * cooling_share_ * (kAmbientDegc - tool_degc_);
}

}  // namespace morepro::host
