#pragma once
#include <cstdint>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {

/// What the sensors make of the truth: noise, then rounding to the last bit. Every channel has random numbers
/// of its own, so that one more sensor does not change the others.
class SensorModel {
 public:
  SensorModel(const Sensors& sensors, std::uint64_t seed);

  /// bit_of(channel) of the sampled channels that the machine has a sensor for.
  [[nodiscard]] std::uint16_t measured() const { return measured_; }
  /// Puts one sample into the frame, where the machine has a sensor for it.
  void measure(Channel channel, double truth, SensorFrame& frame);

 private:
  Sensors sensors_;
  std::uint16_t measured_ = 0;
  std::vector<NormalNumbers> noise_;
};

}  // namespace morepro::host
