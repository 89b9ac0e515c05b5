#pragma once
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "tests/support/spindle_simulation.hpp"

namespace morepro::test {

/// A cut as frames: air, then from `contact_frame` on contact with `chip_load_mm`, commanded as
/// `commanded_mm`.
struct Cut {
  int frames = 6000;
  int contact_frame = 2000;
  double chip_load_mm = 0.05;
  double commanded_mm = 0.05;
  std::uint32_t first_sequence = 0;
  std::uint32_t first_time_us = 0;
  std::uint64_t seed = 1;
};

inline std::vector<SensorFrame> frames_of(const MonitorConfiguration& configuration, const Cut& cut) {
  SpindleSimulation machine(configuration, cut.seed);
  machine.input = {.armature_voltage_v = 48.0, .feed_force_n = 26.0, .tool_temperature_degc = 500.0};
  const auto period_us = static_cast<std::uint32_t>(1.0e6 / configuration.sampling.rate_hz + 0.5);
  std::normal_distribution<double> normal;
  std::vector<SensorFrame> frames;
  for (int k = 0; k < cut.frames; ++k) {
    machine.input.contact = k >= cut.contact_frame ? 1.0 : 0.0;
    machine.input.chip_load_mm = cut.chip_load_mm;
    const auto y = machine.measure();
    SensorFrame frame;
    frame.sequence = cut.first_sequence + static_cast<std::uint32_t>(k);
    frame.time_us = cut.first_time_us + static_cast<std::uint32_t>(k) * period_us;
    frame.set(Channel::kArmatureVoltage, 48.0F);
    frame.set(Channel::kFeedForce, 26.0F);
    frame.set(Channel::kContact, static_cast<float>(machine.input.contact));
    frame.set(Channel::kEngagement, 1.0F);
    frame.set(Channel::kSpindleSpeed, y.speed_rad_s);
    frame.set(Channel::kArmatureCurrent, y.current_a);
    frame.set(Channel::kFeedSpeed,
              static_cast<float>(machine.state().feed_speed_m_s + 0.002 * normal(machine.random())));
    frame.set(Channel::kToolTemperature, 500.0F);
    frame.set(Channel::kChipLoad, static_cast<float>(cut.commanded_mm));
    frames.push_back(frame);
    machine.step();
  }
  return frames;
}

}  // namespace morepro::test
