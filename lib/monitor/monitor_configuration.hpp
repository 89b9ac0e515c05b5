#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/frame/channel.hpp"
#include "lib/gap/applied_effect.hpp"
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/math/elementary.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// One sensor: standard deviation of its noise and size of its last bit, both in the channel's unit, >= 0.
struct SensorNoise {
  double noise = 0.0;
  double lsb = 0.0;

  /// Variance of one sample: noise and the uniform error of rounding to the last bit.
  [[nodiscard]] constexpr double variance() const { return noise * noise + lsb * lsb / 12.0; }
  /// What a coarser step is stated in.
  [[nodiscard]] constexpr double unit() const { return lsb > 0.0 ? lsb : noise; }
  /// A step that adds less than a tenth to the noise that is known changes nothing.
  [[nodiscard]] float coarsest_step() const {
    return math::sqrt(static_cast<float>(1.2 * (lsb * lsb + variance())));
  }
};

/// Noise of every channel; zero where a machine has no such sensor or its noise is not known.
struct Sensors {
  std::array<SensorNoise, kChannelCount> by_channel{};

  constexpr SensorNoise& operator[](Channel channel) { return by_channel[index_of(channel)]; }
  constexpr const SensorNoise& operator[](Channel channel) const { return by_channel[index_of(channel)]; }
};

constexpr Sensors reference_sensors() {
  Sensors sensors;
  sensors[Channel::kSpindleSpeed] = {1.0, 0.0};
  sensors[Channel::kFeedSpeed] = {0.002, 0.0};
  sensors[Channel::kFeedPosition] = {1.0e-6, 0.0};
  sensors[Channel::kArmatureCurrent] = {0.05, 0.0};
  sensors[Channel::kSpindleAcceleration] = {200.0, 0.0};
  sensors[Channel::kFeedAcceleration] = {0.3, 0.0};
  sensors[Channel::kToolTemperature] = {0.5, 0.0};
  sensors[Channel::kWindingTemperature] = {0.5, 0.0};
  return sensors;
}

constexpr Sensors thesis_sensors() {
  Sensors sensors = reference_sensors();
  sensors[Channel::kSpindleSpeed] = {0.5, 0.0};
  sensors[Channel::kArmatureCurrent] = {0.1, 0.0};
  sensors[Channel::kSpindleAcceleration] = {1000.0, 0.0};
  return sensors;
}

struct Sampling {
  double rate_hz = 10000.0;  ///< 100 .. 20000
};

enum class DecisionRule : std::uint8_t { kMarkov = 0, kBayesian = 1, kThesis = 2 };

/// Chip loads that the bank holds: `count` values from `first_mm` in steps of `step_mm`.
struct HypothesisGrid {
  double first_mm = 0.02;    ///< > 0
  double step_mm = 0.01;     ///< > 0
  std::uint32_t count = 10;  ///< 1 .. the bank's size

  [[nodiscard]] constexpr double value_mm(std::size_t index) const {
    return first_mm + static_cast<double>(index) * step_mm;
  }
};

/// Choices of the estimators, not of the machine.
struct FilterTuning {
  double speed_process_noise_rad_s = 0.02;  ///< standard deviation per step, > 0
  double current_process_noise_a = 0.01;    ///< standard deviation per step, > 0
  double feed_process_noise_m_s = 1.0e-4;   ///< standard deviation per step, > 0
  double chip_load_drift_mm = 5.0e-5;       ///< standard deviation per step of the continuous chip load, > 0
  double switch_probability = 1.0e-4;       ///< per step, for the Markov rule, in (0, 1)
  double parameter_start_fraction = 0.3;    ///< standard deviation of the datasheet's values, relative, > 0
};

/// When the chip load that the torque looks like, divided by the commanded one, is worth a word.
struct WearLimits {
  double watch_ratio = 1.2;           ///< > 1
  double replace_ratio = 1.5;         ///< > watch_ratio
  double low_ratio = 0.8;             ///< in (0, 1): below, the tool does not cut what it should
  double hold_s = 0.1;                ///< how long it must last, >= 0
  double datasheet_tolerance = 0.05;  ///< of motor torque and viscous friction, relative, >= 0
};

/// What a host has found out about the machine for the watch of its gap to the model. How random the machine
/// is: standard deviation that one sampling interval adds, >= 0.
struct GapTuning {
  double speed_process_noise_rad_s = 0.01;  ///< this and the following: 1 % of the sensor's noise
  double current_process_noise_a = 5.0e-4;
  double feed_process_noise_m_s = 2.0e-5;
  double lost_share = 5.0e-4;   ///< of its frames that a good link loses, 0 .. 1; 0: nobody looks
  double clock_jitter_s = 0.0;  ///< standard deviation of the sampling instants, as far as it is known, >= 0
  gap::GapLimits spindle;
  gap::GapLimits feed;
};

/// What the machine is known to have beyond the nominal model.
struct MachineEffects {
  static constexpr std::size_t kMost = 4;
  std::array<gap::AppliedEffect, kMost> effect{};  ///< those behind `count` mean nothing
  std::uint32_t count = 0;                         ///< 0 .. kMost
};

/// Everything that a monitor needs to know before its first frame.
struct MonitorConfiguration {
  MachineParameters machine;
  Sensors sensors = reference_sensors();
  Sampling sampling;
  HypothesisGrid grid;
  FilterTuning tuning;
  WearLimits wear;
  GapTuning gap;
  MachineEffects effects;
  DecisionRule rule = DecisionRule::kMarkov;
};

constexpr MonitorConfiguration reference_configuration() { return MonitorConfiguration{}; }

constexpr MonitorConfiguration thesis_configuration() {
  MonitorConfiguration configuration;
  configuration.machine = thesis_machine();
  configuration.sensors = thesis_sensors();
  configuration.grid = {.first_mm = 0.1, .step_mm = 0.1, .count = 11};
  configuration.tuning.speed_process_noise_rad_s = 0.05;
  configuration.tuning.current_process_noise_a = 0.05;
  configuration.tuning.chip_load_drift_mm = 5.0e-4;
  configuration.gap.speed_process_noise_rad_s = 0.005;
  configuration.gap.current_process_noise_a = 0.001;
  return configuration;
}

}  // namespace morepro
