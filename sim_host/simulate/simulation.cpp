#include "sim_host/simulate/simulation.hpp"

#include <cmath>

namespace morepro::host {
namespace {

// Room for acceleration and dither above the voltage of the steady cut.
constexpr double kVoltageReserve = 1.5;

constexpr std::uint16_t kInputs = bit_of(Channel::kArmatureVoltage) | bit_of(Channel::kFeedForce) |
                                  bit_of(Channel::kContact) | bit_of(Channel::kEngagement) |
                                  bit_of(Channel::kChipLoad);

}  // namespace

Simulation::Simulation(const MonitorConfiguration& configuration, const SimulationOptions& options)
    : parameters_(configuration.machine),
      period_s_(1.0 / options.rate_hz),
      frame_count_(static_cast<std::uint64_t>(std::llround(options.duration_s * options.rate_hz))),
      profile_(options.profile, parameters_, options.duration_s, options.seed),
      sensors_(configuration.sensors, options.seed),
      sampling_(options.effects, options.seed),
      disturbance_(configuration, options.process_noise, period_s_, options.seed),
      machine_(parameters_, period_s_, options.effects),
      speed_controller_(
          speed_controller(parameters_, kVoltageReserve * profile_.operating_point().voltage_v)),
      feed_controller_(feed_controller(parameters_)) {}

std::uint16_t Simulation::recorded() const {
  return static_cast<std::uint16_t>(kInputs | sensors_.measured());
}

bool Simulation::next(SensorFrame& frame) {
  while (index_ < frame_count_) {
    sample(frame);
    if (!sampling_.is_lost()) return true;
  }
  return false;
}

void Simulation::sample(SensorFrame& frame) {
  const double time_s = static_cast<double>(index_) * period_s_;
  frame = SensorFrame{};
  frame.sequence = static_cast<std::uint32_t>(index_);
  frame.time_us = static_cast<std::uint32_t>(std::llround(time_s * 1.0e6));
  sampling_.next(index_, time_s);
  sensors_.set_quantization(sampling_.quantization());
  machine_.disturb(disturbance_.next());
  measure_state(frame);
  apply(profile_.at(time_s), frame);
  measure_accelerations(frame);
  machine_.step(input_of(frame));
  ++index_;
}

// A sample that is late or early sees the motion of the interval before: its inputs end with the sample.
void Simulation::measure_state(SensorFrame& frame) {
  const PlantState<double>& state = machine_.state();
  const PlantState<double> seen = advanced(state, sampling_.late_s(), machine_.last_rate());
  const gap::Contribution<double>& error = machine_.sensor_error();
  const double late_s = sampling_.late_s();
  sensors_.measure(Channel::kSpindleSpeed, seen.speed_rad_s + error.speed_rad_s, frame);
  sensors_.measure(Channel::kSpindleAngle, machine_.angle_rad() + late_s * state.speed_rad_s, frame);
  sensors_.measure(Channel::kFeedSpeed, seen.feed_speed_m_s + error.feed_speed_m_s, frame);
  sensors_.measure(Channel::kFeedPosition, machine_.position_m() + late_s * state.feed_speed_m_s, frame);
  sensors_.measure(Channel::kArmatureCurrent, seen.current_a + error.current_a, frame);
  sensors_.measure(Channel::kToolTemperature, machine_.temperatures().tool_degc(), frame);
  sensors_.measure(Channel::kWindingTemperature, machine_.temperatures().winding_degc(), frame);
}

// The controllers see what their sensors see; where a machine has none they see the truth.
void Simulation::apply(const Command& command, SensorFrame& frame) {
  const PlantState<double>& state = machine_.state();
  const auto seen = [&frame](Channel channel, double truth) {
    return frame.has(channel) ? static_cast<double>(frame.get(channel)) : truth;
  };
  double voltage_v = command.voltage_v;
  if (command.is_speed_controlled) {
    const double error = command.speed_rad_s - seen(Channel::kSpindleSpeed, state.speed_rad_s);
    const double feedforward_v = parameters_.spindle.back_emf_constant_vs_rad * command.speed_rad_s;
    voltage_v += speed_controller_.step(error, feedforward_v, period_s_);
  }
  const double feed_error = command.feed_speed_m_s - seen(Channel::kFeedSpeed, state.feed_speed_m_s);
  const double feed_drag_n = parameters_.feed.viscous_friction_ns_m * command.feed_speed_m_s;
  const double force_n = command.force_dither_n + feed_controller_.step(feed_error, feed_drag_n, period_s_);
  frame.set(Channel::kArmatureVoltage, static_cast<float>(voltage_v));
  frame.set(Channel::kFeedForce, static_cast<float>(force_n));
  frame.set(Channel::kContact, static_cast<float>(command.contact));
  frame.set(Channel::kEngagement, static_cast<float>(command.engagement * parameters_.feed.engagement));
  frame.set(Channel::kChipLoad, static_cast<float>(command.chip_load_mm));
}

void Simulation::measure_accelerations(SensorFrame& frame) {
  const PlantDerivative<double> rate = machine_.derivative(input_of(frame));
  sensors_.measure(Channel::kSpindleAcceleration, rate.acceleration_rad_s2, frame);
  sensors_.measure(Channel::kFeedAcceleration, rate.feed_acceleration_m_s2, frame);
}

// What is recorded is what was applied, to the last bit.
PlantInput<double> Simulation::input_of(const SensorFrame& frame) const {
  const auto at = [&frame](Channel channel) { return static_cast<double>(frame.get(channel)); };
  return {.armature_voltage_v = at(Channel::kArmatureVoltage),
          .feed_force_n = at(Channel::kFeedForce),
          .contact = at(Channel::kContact),
          .engagement = at(Channel::kEngagement),
          .chip_load_mm = at(Channel::kChipLoad),
          .tool_temperature_degc = machine_.temperatures().tool_degc()};
}

}  // namespace morepro::host
