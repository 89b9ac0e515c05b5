#include "spindle_plant.h"

#include <morepro_plant.h>

static morepro_machine machine_of(int is_thesis) {
  return is_thesis ? morepro_thesis_machine() : morepro_reference_machine();
}

int spindle_plant_derivative(int is_thesis, const double state[3], const double input[6],
                             double derivative[3]) {
  const morepro_machine machine = machine_of(is_thesis);
  return morepro_plant_derivative(&machine, state, input, derivative);
}

int spindle_plant_step(int is_thesis, double step_s, const double state[3], const double input[6],
                       double next_state[3]) {
  const morepro_machine machine = machine_of(is_thesis);
  return morepro_plant_step(&machine, step_s, state, input, next_state);
}
