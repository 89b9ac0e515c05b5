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
  /// From now on speeds and current are rounded to this many last bits, or standard deviations where there is
  /// no last bit; 0: as described.
  void set_quantization(double size) { quantization_ = size; }
  /// Puts one sample into the frame, where the machine has a sensor for it.
  void measure(Channel channel, double truth, SensorFrame& frame);

 private:
  [[nodiscard]] double step_of(Channel channel) const;

  Sensors sensors_;
  double quantization_ = 0.0;
  std::uint16_t measured_ = 0;
  std::vector<NormalNumbers> noise_;
};

}  // namespace morepro::host
