#pragma once
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// Proportional-integral control with a limit that stops the integral where it is reached.
class PiController {
 public:
  struct Gains {
    double proportional = 0.0;
    double integral_per_s = 0.0;
    double limit = 0.0;  ///< of the output's magnitude, > 0
  };
  explicit PiController(const Gains& gains) : gains_(gains) {}

  /// Output for the coming `step_s`, with `feedforward` added inside the limit.
  double step(double error, double feedforward, double step_s);

 private:
  Gains gains_;
  double integral_ = 0.0;
};

/// Spindle speed by armature voltage, 40 rad/s of bandwidth; the drive gives at most `limit_v`.
PiController speed_controller(const MachineParameters& machine, double limit_v);

/// Feed speed by feed force, 30 rad/s of bandwidth.
PiController feed_controller(const MachineParameters& machine);

}  // namespace morepro::host
