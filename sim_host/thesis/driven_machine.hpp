#pragma once
#include <cstdint>

#include "lib/monitor/monitor_configuration.hpp"
#include "lib/plant/integrators.hpp"
#include "sim_host/simulate/random_numbers.hpp"
#include "sim_host/thesis/identification_run.hpp"

namespace morepro::host::thesis {

/// The thesis's machine with its inputs and the noise of its sensors, sample by sample at 10 kHz.
class DrivenMachine {
 public:
  static constexpr double kPeriodS = 1.0e-4;
  // Standard deviations of the measured derivatives, which the thesis does not state: accelerometers on
  // spindle and feed, and a current that is differentiated over some samples.
  static constexpr double kAccelerationNoiseRadS2 = 1.0e3;
  static constexpr double kFeedAccelerationNoiseMS2 = 0.3;
  static constexpr double kCurrentRateNoiseAS = 2.0e4;

  DrivenMachine(Drive drive, std::uint64_t seed);

  /// Drives the machine over the next period.
  void step();

  [[nodiscard]] const PlantInput<double>& input() const { return input_; }
  [[nodiscard]] const PlantState<double>& state() const { return state_; }
  /// State and derivatives with the noise of their sensors.
  PlantState<double> measured_state();
  PlantDerivative<double> measured_derivative();

 private:
  void drive();

  MonitorConfiguration configuration_ = thesis_configuration();
  Drive drive_;
  std::uint64_t seed_;
  NormalNumbers noise_;
  ExponentialIntegrator<double> integrator_;
  PlantInput<double> input_;
  PlantState<double> state_;
  std::uint64_t frames_ = 0;
};

}  // namespace morepro::host::thesis
