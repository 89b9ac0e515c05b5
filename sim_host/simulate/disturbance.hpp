#pragma once
#include <cstdint>

#include "lib/monitor/monitor_configuration.hpp"
#include "lib/plant/plant_state.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {

/// Process noise: random load, feed force and supply ripple that nobody records, Ornstein-Uhlenbeck with a
/// correlation time of 1 ms, held between two samples. With a fraction of 1 each would move its state by one
/// standard deviation of that state's sensor if it kept its size for 1 ms.
class Disturbance {
 public:
  Disturbance(const MonitorConfiguration& configuration, double fraction, double step_s, std::uint64_t seed);

  /// Terms of the state's derivatives for the next step.
  PlantDerivative<double> next();

 private:
  double keep_;
  double renew_;
  PlantDerivative<double> scale_;
  PlantDerivative<double> value_;
  NormalNumbers torque_;
  NormalNumbers force_;
  NormalNumbers voltage_;
};

}  // namespace morepro::host
