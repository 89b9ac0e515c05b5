#pragma once
#include <cstdint>
#include <random>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/plant/dynamics.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro::test {

/// The spindle of a machine, integrated in double far below the sampling period, with the noise of its
/// sensors.
class SpindleSimulation {
 public:
  SpindleSimulation(const MonitorConfiguration& configuration, std::uint64_t seed)
      : configuration_(configuration),
        law_(configuration.machine),
        plant_(configuration.machine, 1.0 / configuration.sampling.rate_hz / kSubSteps),
        random_(seed) {}

  /// Inputs that hold until the next step.
  PlantInput<double> input{};

  SpindleMeasurement<float> measure() {
    const auto speed = configuration_.sensors[Channel::kSpindleSpeed];
    const auto current = configuration_.sensors[Channel::kArmatureCurrent];
    return {static_cast<float>(state_.speed_rad_s + speed.noise * normal_(random_)),
            static_cast<float>(state_.current_a + current.noise * normal_(random_)),
            static_cast<float>(speed.variance()), static_cast<float>(current.variance())};
  }

  void step() {
    for (int k = 0; k < kSubSteps; ++k) state_ = plant_.step(state_, input);
  }

  [[nodiscard]] SpindleInput<float> held() const {
    return {static_cast<float>(input.armature_voltage_v), static_cast<float>(input.contact),
            static_cast<float>(law_.thermal_factor(input.tool_temperature_degc))};
  }
  [[nodiscard]] const PlantState<double>& state() const { return state_; }
  void set_state(const PlantState<double>& state) { state_ = state; }
  std::mt19937_64& random() { return random_; }

 private:
  static constexpr int kSubSteps = 10;

  MonitorConfiguration configuration_;
  ContactLaw<double> law_;
  Rk4Integrator<double> plant_;
  PlantState<double> state_{};
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace morepro::test
