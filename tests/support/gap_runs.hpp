#pragma once
#include <cstdint>
#include <vector>

#include "lib/gap/effect_size.hpp"
#include "lib/gap/gap_watch.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/simulate/simulation.hpp"

namespace morepro::test {

/// Frames of simulated runs, and a watch that has seen them.
struct GapRun {
  std::vector<gap::AppliedEffect> effects{};
  host::ProfileKind profile = host::ProfileKind::kRich;
  double duration_s = 12.0;
  std::uint64_t seed = 1;
  double process_noise = 0.0;
};

inline MonitorConfiguration gap_configuration() {
  MonitorConfiguration configuration = reference_configuration();
  configuration.sensors[Channel::kFeedPosition] = {};
  return configuration;
}

inline gap::AppliedEffect gap_effect(gap::Effect effect, double size) {
  const MachineParameters machine = gap_configuration().machine;
  return gap::applied(effect, size, {machine, host::reference_point_of(machine)});
}

inline gap::GapSettings gap_settings() {
  const Sensors sensors = gap_configuration().sensors;
  gap::GapSettings settings;
  auto& noise = settings.noise;
  noise.speed_variance = sensors[Channel::kSpindleSpeed].variance();
  noise.current_variance = sensors[Channel::kArmatureCurrent].variance();
  noise.feed_speed_variance = sensors[Channel::kFeedSpeed].variance();
  noise.feed_position_variance = sensors[Channel::kFeedPosition].variance();
  // The simulated machine has no process noise; so little keeps some hundred samples in the observer's
  // memory.
  constexpr double kShare = 0.01;
  noise.speed_step = kShare * sensors[Channel::kSpindleSpeed].noise;
  noise.current_step = kShare * sensors[Channel::kArmatureCurrent].noise;
  noise.feed_step = kShare * sensors[Channel::kFeedSpeed].noise;
  return settings;
}

/// The frame as the observers take it.
template <class Real>
gap::GapFrame<Real> gap_frame(const SensorFrame& frame) {
  const auto at = [&frame](Channel channel) { return static_cast<Real>(frame.get(channel)); };
  gap::GapFrame<Real> seen;
  seen.input = {at(Channel::kArmatureVoltage), at(Channel::kFeedForce), at(Channel::kContact),
                at(Channel::kEngagement),      at(Channel::kChipLoad),  at(Channel::kToolTemperature)};
  seen.winding_degc = at(Channel::kWindingTemperature);
  seen.speed_rad_s = at(Channel::kSpindleSpeed);
  seen.current_a = at(Channel::kArmatureCurrent);
  seen.feed_speed_m_s = at(Channel::kFeedSpeed);
  seen.feed_position_m = at(Channel::kFeedPosition);
  seen.has_speed = frame.has(Channel::kSpindleSpeed);
  seen.has_current = frame.has(Channel::kArmatureCurrent);
  seen.has_feed_speed = frame.has(Channel::kFeedSpeed);
  seen.has_feed_position = frame.has(Channel::kFeedPosition);
  return seen;
}

template <class Real>
gap::GapWatch<Real> new_watch(const MachineParameters& believed, const gap::GapSettings& settings) {
  return gap::GapWatch<Real>(believed, host::reference_point_of(gap_configuration().machine),
                             1.0 / gap_configuration().sampling.rate_hz, settings);
}

template <class Real>
void watch_run(gap::GapWatch<Real>& watch, const GapRun& run) {
  host::SimulationOptions options;
  options.profile = run.profile;
  options.duration_s = run.duration_s;
  options.seed = run.seed;
  options.effects = run.effects;
  options.process_noise = run.process_noise;
  host::Simulation simulation(gap_configuration(), options);
  SensorFrame frame;
  while (simulation.next(frame)) watch.step(gap_frame<Real>(frame));
}

}  // namespace morepro::test
