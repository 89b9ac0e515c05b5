#include "sim_host/simulate/simulated_machine.hpp"

#include <cmath>

namespace morepro::host {
namespace {

// The integrator is exact but for the contact law's curvature; at 20 us that is far below a float's last bit.
constexpr double kLongestSubstepS = 20.0e-6;

int substeps_for(double period_s) {
  return static_cast<int>(std::ceil(period_s / kLongestSubstepS - 1.0e-9));
}

}  // namespace

SimulatedMachine::SimulatedMachine(const MachineParameters& machine, double period_s)
    : substeps_(substeps_for(period_s)), substep_s_(period_s / substeps_), integrator_(machine, substep_s_) {}

void SimulatedMachine::step(const PlantInput<double>& input) {
  for (int i = 0; i < substeps_; ++i) {
    const PlantState<double> before = state_;
    state_ = integrator_.step(state_, input);
    angle_rad_ += 0.5 * substep_s_ * (before.speed_rad_s + state_.speed_rad_s);
    position_m_ += 0.5 * substep_s_ * (before.feed_speed_m_s + state_.feed_speed_m_s);
  }
}

}  // namespace morepro::host
