#ifndef MOREPRO_PLANT_H
#define MOREPRO_PLANT_H
#include "morepro_error.h"
#include "morepro_machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Indices of a state; its derivative has the same, per second.
enum {
  MOREPRO_STATE_SPEED_RAD_S = 0,
  MOREPRO_STATE_FEED_SPEED_M_S = 1,
  MOREPRO_STATE_CURRENT_A = 2,
  MOREPRO_STATES = 3
};

/// Indices of an input.
enum {
  MOREPRO_INPUT_ARMATURE_VOLTAGE_V = 0,
  MOREPRO_INPUT_FEED_FORCE_N = 1,
  MOREPRO_INPUT_CONTACT = 2,     ///< 0 = air, 1 = the tool cuts
  MOREPRO_INPUT_ENGAGEMENT = 3,  ///< >= 0
  MOREPRO_INPUT_CHIP_LOAD_MM = 4,
  MOREPRO_INPUT_TOOL_TEMPERATURE_DEGC = 5,
  MOREPRO_INPUTS = 6
};

// The machine's equations of motion (equation 18 of the thesis, dimensionally corrected) in double precision.
// Both calls keep nothing: they fit a block that calls C, for example Simulink's C Caller. Arrays may not
// overlap. Errors: MOREPRO_ERROR_NULL_POINTER, MOREPRO_ERROR_UNKNOWN_CHOICE, those of a machine (1 .. 99),
// MOREPRO_ERROR_NOT_FINITE for a state or an input that is no finite number; the result is then not written.

/// d(state)/dt for these inputs.
morepro_error morepro_plant_derivative(const morepro_machine* machine, const double state[MOREPRO_STATES],
                                       const double input[MOREPRO_INPUTS], double derivative[MOREPRO_STATES]);

/// The state after `step_s` (in (0, 1) s, else MOREPRO_ERROR_STEP) with inputs held: the exact step of the
/// system linearised at its beginning. Exact without contact, of second order with it, stable for every step.
morepro_error morepro_plant_step(const morepro_machine* machine, double step_s,
                                 const double state[MOREPRO_STATES], const double input[MOREPRO_INPUTS],
                                 double next_state[MOREPRO_STATES]);

#ifdef __cplusplus
}
#endif

#endif
