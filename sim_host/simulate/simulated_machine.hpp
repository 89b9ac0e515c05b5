#pragma once
#include "lib/plant/integrators.hpp"

namespace morepro::host {

/// The machine itself: the plant of lib in double precision, in sub-steps, and what follows from its motion.
class SimulatedMachine {
 public:
  /// `period_s` > 0: time between two samples; inputs are held over it.
  SimulatedMachine(const MachineParameters& machine, double period_s);

  /// Advances by one period.
  void step(const PlantInput<double>& input);

  [[nodiscard]] const PlantState<double>& state() const { return state_; }
  [[nodiscard]] PlantDerivative<double> derivative(const PlantInput<double>& input) const {
    return integrator_.plant().derivative(state_, input);
  }
  [[nodiscard]] double angle_rad() const { return angle_rad_; }
  [[nodiscard]] double position_m() const { return position_m_; }

 private:
  int substeps_;
  double substep_s_;
  ExponentialIntegrator<double> integrator_;
  PlantState<double> state_;
  double angle_rad_ = 0.0;
  double position_m_ = 0.0;
};

}  // namespace morepro::host
