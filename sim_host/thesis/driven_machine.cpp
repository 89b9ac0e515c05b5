#include "sim_host/thesis/driven_machine.hpp"

namespace morepro::host::thesis {
namespace {

constexpr int kSubSteps = 5;
constexpr double kVoltage = 54.0;
constexpr double kFeedForce = 8.0;
constexpr double kSettlingS = 0.05;

// Excitation: a fast and a slow part of the voltage, one of the force, contact on and off.
constexpr double kVoltageSwing = 6.0, kFastS = 1.0e-3, kSlowS = 20.0e-3;
constexpr double kForceSwing = 4.0, kForceS = 30.0e-3;
constexpr std::uint64_t kContactFrames = 1000;

}  // namespace

DrivenMachine::DrivenMachine(Drive drive_kind, std::uint64_t seed)
    : drive_(drive_kind),
      seed_(seed),
      noise_(seed),
      integrator_(configuration_.machine, kPeriodS / kSubSteps) {
  const MachineParameters& machine = configuration_.machine;
  input_ = {.armature_voltage_v = kVoltage,
            .feed_force_n = kFeedForce,
            .contact = 1.0,
            .engagement = machine.feed.engagement,
            .chip_load_mm = machine.tool.chip_load_mm,
            .tool_temperature_degc = machine.thermal.tool_degc};
  for (int k = 0; k < static_cast<int>(kSettlingS / kPeriodS) * kSubSteps; ++k)
    state_ = integrator_.step(state_, input_);
  state_.feed_speed_m_s = 0.0;
}

void DrivenMachine::drive() {
  if (drive_ == Drive::kConstant) return;
  const double time_s = static_cast<double>(frames_) * kPeriodS;
  input_.armature_voltage_v = kVoltage + kVoltageSwing * (binary_signal(mixed(seed_, 1), time_s, kFastS) +
                                                          binary_signal(mixed(seed_, 2), time_s, kSlowS));
  input_.feed_force_n = kFeedForce + kForceSwing * binary_signal(mixed(seed_, 3), time_s, kForceS);
  input_.contact = (frames_ / kContactFrames) % 2 == 0 ? 1.0 : 0.0;
}

void DrivenMachine::step() {
  drive();
  for (int k = 0; k < kSubSteps; ++k) state_ = integrator_.step(state_, input_);
  ++frames_;
}

PlantState<double> DrivenMachine::measured_state() {
  const Sensors& sensors = configuration_.sensors;
  return {state_.speed_rad_s + sensors[Channel::kSpindleSpeed].noise * noise_.next(),
          state_.feed_speed_m_s + sensors[Channel::kFeedSpeed].noise * noise_.next(),
          state_.current_a + sensors[Channel::kArmatureCurrent].noise * noise_.next()};
}

PlantDerivative<double> DrivenMachine::measured_derivative() {
  const auto rate = integrator_.plant().derivative(state_, input_);
  return {rate.acceleration_rad_s2 + kAccelerationNoiseRadS2 * noise_.next(),
          rate.feed_acceleration_m_s2 + kFeedAccelerationNoiseMS2 * noise_.next(),
          rate.current_rate_a_s + kCurrentRateNoiseAS * noise_.next()};
}

}  // namespace morepro::host::thesis
