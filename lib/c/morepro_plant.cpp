#include "lib/c/morepro_plant.h"

#include "lib/c/machine_conversion.hpp"
#include "lib/monitor/configuration_check.hpp"
#include "lib/plant/integrators.hpp"

namespace {

using morepro::PlantInput;
using morepro::PlantState;

bool are_finite(const double* values, int count) {
  bool finite = true;
  for (int i = 0; i < count; ++i) finite = finite && values[i] - values[i] == 0.0;
  return finite;
}

morepro_error check(const morepro_machine* machine, const double* state, const double* input,
                    const double* result) {
  if (machine == nullptr || state == nullptr || input == nullptr || result == nullptr)
    return MOREPRO_ERROR_NULL_POINTER;
  if (!morepro::c::is_known_form(*machine)) return MOREPRO_ERROR_UNKNOWN_CHOICE;
  if (!are_finite(state, MOREPRO_STATES) || !are_finite(input, MOREPRO_INPUTS))
    return MOREPRO_ERROR_NOT_FINITE;
  return static_cast<morepro_error>(morepro::check(morepro::c::to_cpp(*machine)).error);
}

PlantState<double> state_of(const double* state) {
  return {.speed_rad_s = state[MOREPRO_STATE_SPEED_RAD_S],
          .feed_speed_m_s = state[MOREPRO_STATE_FEED_SPEED_M_S],
          .current_a = state[MOREPRO_STATE_CURRENT_A]};
}

PlantInput<double> input_of(const double* input) {
  return {.armature_voltage_v = input[MOREPRO_INPUT_ARMATURE_VOLTAGE_V],
          .feed_force_n = input[MOREPRO_INPUT_FEED_FORCE_N],
          .contact = input[MOREPRO_INPUT_CONTACT],
          .engagement = input[MOREPRO_INPUT_ENGAGEMENT],
          .chip_load_mm = input[MOREPRO_INPUT_CHIP_LOAD_MM],
          .tool_temperature_degc = input[MOREPRO_INPUT_TOOL_TEMPERATURE_DEGC]};
}

}  // namespace

morepro_error morepro_plant_derivative(const morepro_machine* machine, const double state[MOREPRO_STATES],
                                       const double input[MOREPRO_INPUTS],
                                       double derivative[MOREPRO_STATES]) {
  const morepro_error error = check(machine, state, input, derivative);
  if (error != MOREPRO_OK) return error;
  const morepro::Plant<double> plant(morepro::c::to_cpp(*machine));
  const auto rate = plant.derivative(state_of(state), input_of(input));
  derivative[MOREPRO_STATE_SPEED_RAD_S] = rate.acceleration_rad_s2;
  derivative[MOREPRO_STATE_FEED_SPEED_M_S] = rate.feed_acceleration_m_s2;
  derivative[MOREPRO_STATE_CURRENT_A] = rate.current_rate_a_s;
  return MOREPRO_OK;
}

morepro_error morepro_plant_step(const morepro_machine* machine, double step_s,
                                 const double state[MOREPRO_STATES], const double input[MOREPRO_INPUTS],
                                 double next_state[MOREPRO_STATES]) {
  const morepro_error error = check(machine, state, input, next_state);
  if (error != MOREPRO_OK) return error;
  if (!(step_s > 0.0) || !(step_s < 1.0)) return MOREPRO_ERROR_STEP;
  const morepro::ExponentialIntegrator<double> integrator(morepro::c::to_cpp(*machine), step_s);
  const auto next = integrator.step(state_of(state), input_of(input));
  next_state[MOREPRO_STATE_SPEED_RAD_S] = next.speed_rad_s;
  next_state[MOREPRO_STATE_FEED_SPEED_M_S] = next.feed_speed_m_s;
  next_state[MOREPRO_STATE_CURRENT_A] = next.current_a;
  return MOREPRO_OK;
}
