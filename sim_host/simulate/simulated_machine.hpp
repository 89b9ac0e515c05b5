#pragma once
#include <span>

#include "lib/gap/reference_point.hpp"
#include "lib/plant/integrators.hpp"
#include "sim_host/simulate/sensor_effects.hpp"
#include "sim_host/simulate/state_effects.hpp"
#include "sim_host/simulate/temperatures.hpp"

namespace morepro::host {

/// The machine itself: the plant of lib in double precision, in sub-steps, with the effects that it has
/// beyond the nominal model, and what follows from its motion. Effects enter at the middle of a sub-step and
/// are held over it: second order.
class SimulatedMachine {
 public:
  /// `period_s` > 0: time between two samples; inputs are held over it. Throws UserError where the effects
  /// are too stiff to be simulated, and step() where the machine runs away.
  SimulatedMachine(const MachineParameters& machine, double period_s,
                   std::span<const gap::AppliedEffect> effects = {},
                   double longest_substep_s = kLongestSubstepS);

  /// Terms of the state's derivatives that nothing explains, until the next call.
  void disturb(const PlantDerivative<double>& disturbance) { disturbance_ = disturbance; }
  /// Advances by one period.
  void step(const PlantInput<double>& input);

  [[nodiscard]] const PlantState<double>& state() const { return state_; }
  [[nodiscard]] PlantDerivative<double> derivative(const PlantInput<double>& input) const;
  /// Derivative at the end of the last step, with the inputs of that step.
  [[nodiscard]] const PlantDerivative<double>& last_rate() const { return last_rate_; }
  [[nodiscard]] double angle_rad() const { return angle_rad_; }
  [[nodiscard]] double position_m() const { return position_m_; }
  [[nodiscard]] const Temperatures& temperatures() const { return temperatures_; }
  /// What its sensors show too much, before their noise.
  [[nodiscard]] const gap::Contribution<double>& sensor_error() const { return sensor_effects_.error(); }

 private:
  // The integrator is exact but for the contact law's curvature; at 20 us that is far below a float's last
  // bit.
  static constexpr double kLongestSubstepS = 20.0e-6;

  [[noreturn]] void refuse_to_run_away() const;
  void substep(const PlantInput<double>& input);
  [[nodiscard]] PlantState<double> with_effects(const PlantInput<double>& input);
  [[nodiscard]] gap::EffectSignals<double> signals_at(const PlantState<double>& state, double ahead_s,
                                                      const PlantInput<double>& input) const;

  gap::ReferencePoint point_;
  PlantState<double> far_;
  int sensor_steps_;  ///< per period
  int steps_per_sensor_step_;
  double substep_s_;
  ExponentialIntegrator<double> integrator_;
  Temperatures temperatures_;
  StateEffects state_effects_;
  SensorEffects sensor_effects_;
  PlantState<double> state_;
  PlantDerivative<double> disturbance_;
  PlantDerivative<double> added_;
  PlantDerivative<double> last_rate_;
  double angle_rad_ = 0.0;
  double position_m_ = 0.0;
  double cutting_time_s_ = 0.0;
  double steps_done_ = 0.0;
};

}  // namespace morepro::host
