#ifndef SPINDLE_PLANT_H
#define SPINDLE_PLANT_H
/// For two C Caller blocks of Simulink. state[3]: spindle speed in rad/s, feed speed in m/s, armature current
/// in A. input[6]: armature voltage in V, feed force in N, contact 0 or 1, engagement, chip load in mm, tool
/// temperature in degC. The machine is the thesis's where is_thesis is not 0, else the reference machine. The
/// returned number is a morepro_error: 0 where the result was written.

/// For a model with an Integrator block: d(state)/dt.
int spindle_plant_derivative(int is_thesis, const double state[3], const double input[6],
                             double derivative[3]);

/// For a model with a Unit Delay block: the state one fixed step later.
int spindle_plant_step(int is_thesis, double step_s, const double state[3], const double input[6],
                       double next_state[3]);

#endif
