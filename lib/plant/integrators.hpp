#pragma once
#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/dynamics.hpp"
#include "lib/plant/step_check.hpp"

namespace morepro {

/// x + h f.
template <class Real>
constexpr PlantState<Real> advanced(const PlantState<Real>& x, Real h, const PlantDerivative<Real>& f) {
  return {x.speed_rad_s + h * f.acceleration_rad_s2, x.feed_speed_m_s + h * f.feed_acceleration_m_s2,
          x.current_a + h * f.current_rate_a_s};
}

/// The default integrator: the exact step of the system linearised at its beginning (Rosenbrock-Euler,
/// x + h phi1(h J) f), and the exact step of the feed axis. Exact without contact, second order with it,
/// stable for every step. Inputs are held over the step. Bounded time: may run in an interrupt.
template <class Real>
class ExponentialIntegrator {
 public:
  /// step_s > 0.
  ExponentialIntegrator(const MachineParameters& machine, double step_s)
      : plant_(machine),
        step_s_(static_cast<Real>(step_s)),
        feed_gain_s_(static_cast<Real>(feed_gain(Plant<double>(machine).feed_rate(), step_s))) {}

  PlantState<Real> step(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    const auto linear = plant_.linearise(x, u);
    return moved(x, linear.spindle_jacobian, linear.derivative);
  }

  /// The same with further terms on the right-hand side, held over the step.
  PlantState<Real> step(const PlantState<Real>& x, const PlantInput<Real>& u,
                        const PlantDerivative<Real>& added) const {
    const auto linear = plant_.linearise(x, u);
    const auto& f = linear.derivative;
    return moved(x, linear.spindle_jacobian,
                 {f.acceleration_rad_s2 + added.acceleration_rad_s2,
                  f.feed_acceleration_m_s2 + added.feed_acceleration_m_s2,
                  f.current_rate_a_s + added.current_rate_a_s});
  }

  const Plant<Real>& plant() const { return plant_; }

 private:
  PlantState<Real> moved(const PlantState<Real>& x, const math::BasicMatrix2<Real>& jacobian,
                         const PlantDerivative<Real>& f) const {
    const math::BasicMatrix2<Real> psi = math::exponential_step(jacobian, step_s_).integral;
    return {x.speed_rad_s + (psi.a00 * f.acceleration_rad_s2 + psi.a01 * f.current_rate_a_s),
            x.feed_speed_m_s + feed_gain_s_ * f.feed_acceleration_m_s2,
            x.current_a + (psi.a10 * f.acceleration_rad_s2 + psi.a11 * f.current_rate_a_s)};
  }

  static double feed_gain(double rate, double step_s) {
    return math::exponential_step(math::Matrix2{.a00 = rate}, step_s).integral.a00;
  }

  Plant<Real> plant_;
  Real step_s_;
  Real feed_gain_s_;
};

/// The classical Runge-Kutta step of fourth order. Ask `check` before: it diverges for long steps.
/// Bounded time: may run in an interrupt.
template <class Real>
class Rk4Integrator {
 public:
  Rk4Integrator(const MachineParameters& machine, double step_s)
      : plant_(machine), step_s_(static_cast<Real>(step_s)) {}

  /// kOk where this machine may be integrated with this step.
  [[nodiscard]] static StepStatus check(const MachineParameters& machine, double step_s) {
    return check_rk4_step(machine, step_s);
  }

  /// Inputs held over the step.
  PlantState<Real> step(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    return step(x, u, u, u);
  }

  /// Inputs at the step's beginning, middle and end, for fourth order with inputs that change.
  PlantState<Real> step(const PlantState<Real>& x, const PlantInput<Real>& begin,
                        const PlantInput<Real>& middle, const PlantInput<Real>& end) const {
    const Real half = step_s_ * Real(0.5);
    const auto k1 = plant_.derivative(x, begin);
    const auto k2 = plant_.derivative(advanced(x, half, k1), middle);
    const auto k3 = plant_.derivative(advanced(x, half, k2), middle);
    const auto k4 = plant_.derivative(advanced(x, step_s_, k3), end);
    return advanced(x, step_s_ / Real(6), sum_of(k1, k2, k3, k4));
  }

  const Plant<Real>& plant() const { return plant_; }

 private:
  using Derivative = PlantDerivative<Real>;

  static constexpr Real weighted(Real k1, Real k2, Real k3, Real k4) { return k1 + Real(2) * (k2 + k3) + k4; }

  static constexpr Derivative sum_of(const Derivative& a, const Derivative& b, const Derivative& c,
                                     const Derivative& d) {
    return {
        weighted(a.acceleration_rad_s2, b.acceleration_rad_s2, c.acceleration_rad_s2, d.acceleration_rad_s2),
        weighted(a.feed_acceleration_m_s2, b.feed_acceleration_m_s2, c.feed_acceleration_m_s2,
                 d.feed_acceleration_m_s2),
        weighted(a.current_rate_a_s, b.current_rate_a_s, c.current_rate_a_s, d.current_rate_a_s)};
  }

  Plant<Real> plant_;
  Real step_s_;
};

}  // namespace morepro
