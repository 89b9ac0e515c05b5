#include "sim_host/simulate/simulated_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_host/simulate/effect_rate.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

int substeps_for(double period_s, double longest_s) {
  return static_cast<int>(std::ceil(period_s / longest_s - 1.0e-9));
}

/// How often a step is divided so that the fastest motion of the effects takes two steps or more.
int division_for(double rate_per_s, double step_s) {
  constexpr double kStepsPerTimeConstant = 2.0;
  constexpr double kMost = 200.0;
  const double wanted = std::ceil(kStepsPerTimeConstant * rate_per_s * step_s);
  if (!(wanted <= kMost))
    throw UserError(
        "the effects are too stiff to be simulated; make the friction, voltage or stiffness smaller");
  return wanted > 1.0 ? static_cast<int>(wanted) : 1;
}

PlantDerivative<double> sum_of(const PlantDerivative<double>& a, const PlantDerivative<double>& b) {
  return {a.acceleration_rad_s2 + b.acceleration_rad_s2, a.feed_acceleration_m_s2 + b.feed_acceleration_m_s2,
          a.current_rate_a_s + b.current_rate_a_s};
}

PlantDerivative<double> rate_between(const PlantState<double>& a, const PlantState<double>& b,
                                     double step_s) {
  return {(b.speed_rad_s - a.speed_rad_s) / step_s, (b.feed_speed_m_s - a.feed_speed_m_s) / step_s,
          (b.current_a - a.current_a) / step_s};
}

/// Where no machine is: far beyond what any profile asks for, and long before anything is too large for the
/// floats of a recording.
PlantState<double> far_from(const gap::ReferencePoint& point, const MachineParameters& machine) {
  constexpr double kFar = 1000.0;
  constexpr double kSlowestFeedMS = 1.0e-3;
  constexpr double kSmallestVoltageV = 2.4;
  PlantState<double> far;
  far.speed_rad_s = kFar * point.speed_rad_s;
  far.feed_speed_m_s = kFar * std::max(point.feed_speed_m_s, kSlowestFeedMS);
  far.current_a = kFar * std::max(point.current_a, kSmallestVoltageV / machine.spindle.resistance_ohm);
  return far;
}

bool is_away(const PlantState<double>& state, const PlantState<double>& far) {
  return !(std::fabs(state.speed_rad_s) < far.speed_rad_s &&
           std::fabs(state.feed_speed_m_s) < far.feed_speed_m_s &&
           std::fabs(state.current_a) < far.current_a);
}

bool is_zero(const PlantDerivative<double>& rate) {
  return rate.acceleration_rad_s2 == 0.0 && rate.feed_acceleration_m_s2 == 0.0 &&
         rate.current_rate_a_s == 0.0;
}

}  // namespace

SimulatedMachine::SimulatedMachine(const MachineParameters& machine, double period_s,
                                   std::span<const gap::AppliedEffect> effects, double longest_substep_s)
    : point_(reference_point_of(machine)),
      far_(far_from(point_, machine)),
      sensor_steps_(substeps_for(period_s, longest_substep_s)),
      steps_per_sensor_step_(
          division_for(fastest_rate(effects, {machine, point_}), period_s / sensor_steps_)),
      substep_s_(period_s / (sensor_steps_ * steps_per_sensor_step_)),
      integrator_(machine, substep_s_),
      temperatures_(machine, point_, period_s),
      state_effects_(effects, {machine, point_}, substep_s_),
      sensor_effects_(effects, {machine, point_}, period_s / sensor_steps_) {
  sensor_effects_.step(signals_at(state_, 0.0, {}));
}

void SimulatedMachine::step(const PlantInput<double>& input) {
  double square_a2 = 0.0;
  for (int i = 0; i < sensor_steps_; ++i) {
    for (int k = 0; k < steps_per_sensor_step_; ++k) substep(input);
    square_a2 += state_.current_a * state_.current_a;
    if (!sensor_effects_.is_empty()) sensor_effects_.step(signals_at(state_, 0.0, input));
  }
  if (is_away(state_, far_)) refuse_to_run_away();
  temperatures_.step(square_a2 / sensor_steps_, input.contact);
}

void SimulatedMachine::refuse_to_run_away() const {
  const bool has_effects = !state_effects_.is_empty() || !sensor_effects_.is_empty();
  const char* const advice = has_effects ? "an effect is larger than a machine can have it; make it smaller"
                                         : "check the machine file's values and the process noise";
  throw UserError(fmt::format("the simulated machine runs away {:.4g} s after its start: {}",
                              steps_done_ * substep_s_, advice));
}

void SimulatedMachine::substep(const PlantInput<double>& input) {
  const PlantState<double> before = state_;
  const bool is_nominal = state_effects_.is_empty() && is_zero(disturbance_);
  state_ = is_nominal ? integrator_.step(before, input) : with_effects(input);
  last_rate_ = rate_between(before, state_, substep_s_);
  angle_rad_ += 0.5 * substep_s_ * (before.speed_rad_s + state_.speed_rad_s);
  position_m_ += 0.5 * substep_s_ * (before.feed_speed_m_s + state_.feed_speed_m_s);
  cutting_time_s_ += input.contact * substep_s_;
  steps_done_ += 1.0;
}

PlantState<double> SimulatedMachine::with_effects(const PlantInput<double>& input) {
  const double half_s = 0.5 * substep_s_;
  const auto rate = sum_of(integrator_.plant().derivative(state_, input), sum_of(added_, disturbance_));
  added_ = state_effects_.step(signals_at(advanced(state_, half_s, rate), half_s, input));
  return integrator_.step(state_, input, sum_of(added_, disturbance_));
}

PlantDerivative<double> SimulatedMachine::derivative(const PlantInput<double>& input) const {
  const auto nominal = integrator_.plant().derivative(state_, input);
  if (state_effects_.is_empty()) return sum_of(nominal, disturbance_);
  return sum_of(nominal, sum_of(state_effects_.at(signals_at(state_, 0.0, input)), disturbance_));
}

gap::EffectSignals<double> SimulatedMachine::signals_at(const PlantState<double>& state, double ahead_s,
                                                        const PlantInput<double>& input) const {
  const auto nominal = integrator_.plant().derivative(state, input);
  return {.time_s = steps_done_ * substep_s_ + ahead_s,
          .cutting_time_s = cutting_time_s_ + input.contact * ahead_s,
          .armature_voltage_v = input.armature_voltage_v,
          .feed_force_n = input.feed_force_n,
          .contact = input.contact,
          .chip_load_mm = input.chip_load_mm,
          .speed_rad_s = state.speed_rad_s,
          .angle_rad = angle_rad_ + ahead_s * state_.speed_rad_s,
          .current_a = state.current_a,
          .feed_speed_m_s = state.feed_speed_m_s,
          .feed_position_m = position_m_ + ahead_s * state_.feed_speed_m_s,
          .tool_degc = temperatures_.tool_degc(),
          .winding_degc = temperatures_.winding_degc(),
          .acceleration_rad_s2 = nominal.acceleration_rad_s2,
          .current_rate_a_s = nominal.current_rate_a_s,
          .driven_speed_rad_s = state.speed_rad_s,
          .driven_current_a = state.current_a,
          .driven_feed_speed_m_s = state.feed_speed_m_s};
}

}  // namespace morepro::host
