#pragma once
#include <cstdint>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/simulate/controller.hpp"
#include "sim_host/simulate/disturbance.hpp"
#include "sim_host/simulate/profile.hpp"
#include "sim_host/simulate/sampling_effects.hpp"
#include "sim_host/simulate/sensors.hpp"
#include "sim_host/simulate/simulated_machine.hpp"

namespace morepro::host {

struct SimulationOptions {
  ProfileKind profile = ProfileKind::kCutting;
  double duration_s = 5.0;
  double rate_hz = 10000.0;
  std::uint64_t seed = 1;
  std::vector<gap::AppliedEffect> effects{};
  double process_noise = 0.0;  ///< see Disturbance, >= 0
};

/// One run: profile -> controllers -> machine with effects -> sensors, one frame per sample. The same options
/// give the same frames on every machine.
class Simulation {
 public:
  Simulation(const MonitorConfiguration& configuration, const SimulationOptions& options);

  /// The next frame; false at the end of the run.
  bool next(SensorFrame& frame);

  /// Samples of the run, with those that are lost.
  [[nodiscard]] std::uint64_t frame_count() const { return frame_count_; }
  /// bit_of(channel) of everything that the frames hold.
  [[nodiscard]] std::uint16_t recorded() const;

 private:
  void sample(SensorFrame& frame);
  void measure_state(SensorFrame& frame);
  void apply(const Command& command, SensorFrame& frame);
  void measure_accelerations(SensorFrame& frame);
  [[nodiscard]] PlantInput<double> input_of(const SensorFrame& frame) const;

  MachineParameters parameters_;
  double period_s_;
  std::uint64_t frame_count_;
  Profile profile_;
  SensorModel sensors_;
  SamplingEffects sampling_;
  Disturbance disturbance_;
  SimulatedMachine machine_;
  PiController speed_controller_;
  PiController feed_controller_;
  std::uint64_t index_ = 0;
};

}  // namespace morepro::host
