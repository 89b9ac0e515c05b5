#pragma once
#include <Eigen/Core>
#include <array>

#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/contact_law.hpp"
#include "lib/plant/machine_parameters.hpp"
#include "lib/plant/parameter.hpp"
#include "lib/plant/plant_state.hpp"

namespace morepro {

/// The machine's equations of motion (equation 18 of the thesis, dimensionally corrected) with their
/// Jacobians:
///   In dw/dt = Kt i - Att w - Fc tau(w, CL, T)      spindle torque
///   m  dv/dt = F1 - bx v - Fc (F2 alpha + c)        feed force
///   L  di/dt = V - R i - Kv w                       armature voltage
/// The feed axis shares nothing with the other two. SI units; contact_law.hpp holds tau.
/// No memory, bounded time: may run in an interrupt.
template <class Real>
class Plant {
 public:
  using StateMatrix = Eigen::Matrix<Real, kPlantStates, kPlantStates>;
  using ParameterMatrix = Eigen::Matrix<Real, kPlantStates, static_cast<int>(kParameterCount)>;
  using SpindleMatrix = math::BasicMatrix2<Real>;
  using Theta = std::array<Real, kParameterCount>;

  explicit Plant(const MachineParameters& machine)
      : theta_(theta_of(machine)),
        viscous_friction_nms_rad_(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        feed_viscous_friction_ns_m_(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        contact_offset_n_(static_cast<Real>(machine.feed.contact_offset_n)),
        contact_law_(machine) {}

  /// Values of the identifiable parameters, in the order of Parameter.
  const Theta& theta() const { return theta_; }
  /// Takes other values; inertia, mass and inductance must be > 0.
  void set_theta(const Theta& theta) { theta_ = theta; }

  const ContactLaw<Real>& contact_law() const { return contact_law_; }

  PlantDerivative<Real> derivative(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    return derivative(x, u, cut(x, u));
  }

  /// A = d(dw, dv, di)/d(w, v, i).
  StateMatrix state_jacobian(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    const SpindleMatrix spindle = spindle_jacobian(x, u);
    StateMatrix a = StateMatrix::Zero();
    a(kSpeedIndex, kSpeedIndex) = spindle.a00;
    a(kSpeedIndex, kCurrentIndex) = spindle.a01;
    a(kFeedSpeedIndex, kFeedSpeedIndex) = feed_rate();
    a(kCurrentIndex, kSpeedIndex) = spindle.a10;
    a(kCurrentIndex, kCurrentIndex) = spindle.a11;
    return a;
  }

  /// The block of A that couples speed and current, d(dw, di)/d(w, i).
  SpindleMatrix spindle_jacobian(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    return spindle_jacobian(cut(x, u));
  }

  /// Derivative and spindle Jacobian at once, for one evaluation of the contact law.
  struct Linearisation {
    PlantDerivative<Real> derivative;
    SpindleMatrix spindle_jacobian;
    std::uint8_t contact_flags = 0;  ///< ContactFlag bits, 0 without contact
  };
  Linearisation linearise(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    const Cut tau = cut(x, u);
    return {derivative(x, u, tau), spindle_jacobian(tau), tau.flags};
  }

  /// The feed axis's only entry of A: -bx/m in 1/s, constant.
  Real feed_rate() const { return -feed_viscous_friction_ns_m_ / at(Parameter::kMass); }

  /// C = d(dw, dv, di)/d(theta), columns in the order of Parameter (equation 22, with its zeros put back).
  ParameterMatrix parameter_jacobian(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    const PlantDerivative<Real> rate = derivative(x, u);
    ParameterMatrix c = ParameterMatrix::Zero();
    c(kSpeedIndex, column(Parameter::kTorqueConstant)) = x.current_a / at(Parameter::kInertia);
    c(kSpeedIndex, column(Parameter::kInertia)) = -rate.acceleration_rad_s2 / at(Parameter::kInertia);
    c(kFeedSpeedIndex, column(Parameter::kMass)) = -rate.feed_acceleration_m_s2 / at(Parameter::kMass);
    c(kFeedSpeedIndex, column(Parameter::kContactForce)) = -u.engagement * u.contact / at(Parameter::kMass);
    c(kCurrentIndex, column(Parameter::kInductance)) = -rate.current_rate_a_s / at(Parameter::kInductance);
    c(kCurrentIndex, column(Parameter::kResistance)) = -x.current_a / at(Parameter::kInductance);
    c(kCurrentIndex, column(Parameter::kBackEmfConstant)) = -x.speed_rad_s / at(Parameter::kInductance);
    return c;
  }

 private:
  /// The part of the contact torque that depends on the state, times Fc.
  struct Cut {
    Real torque_nm = 0;
    Real per_speed = 0;
    std::uint8_t flags = 0;
  };

  static Theta theta_of(const MachineParameters& machine) {
    const auto& [spindle, feed, tool, contact, thermal] = machine;
    return {static_cast<Real>(spindle.torque_constant_nm_a),
            static_cast<Real>(spindle.inertia_kgm2),
            static_cast<Real>(feed.mass_kg),
            static_cast<Real>(feed.contact_force_n),
            static_cast<Real>(spindle.inductance_h),
            static_cast<Real>(spindle.resistance_ohm),
            static_cast<Real>(spindle.back_emf_constant_vs_rad)};
  }

  static constexpr int column(Parameter parameter) { return static_cast<int>(index_of(parameter)); }
  Real at(Parameter parameter) const { return theta_[index_of(parameter)]; }

  Cut cut(const PlantState<Real>& x, const PlantInput<Real>& u) const {
    if (u.contact == Real(0)) return {};
    const ContactTorque<Real> tau = contact_law_(x.speed_rad_s, u.chip_load_mm, u.tool_temperature_degc);
    return {u.contact * tau.torque_nm, u.contact * tau.per_speed, tau.flags};
  }

  PlantDerivative<Real> derivative(const PlantState<Real>& x, const PlantInput<Real>& u,
                                   const Cut& tau) const {
    const Real drive_nm = at(Parameter::kTorqueConstant) * x.current_a;
    const Real drag_nm = viscous_friction_nms_rad_ * x.speed_rad_s + tau.torque_nm;
    const Real cutting_n = u.contact * (at(Parameter::kContactForce) * u.engagement + contact_offset_n_);
    const Real feed_n = u.feed_force_n - feed_viscous_friction_ns_m_ * x.feed_speed_m_s - cutting_n;
    const Real drop_v =
        at(Parameter::kResistance) * x.current_a + at(Parameter::kBackEmfConstant) * x.speed_rad_s;
    return {(drive_nm - drag_nm) / at(Parameter::kInertia), feed_n / at(Parameter::kMass),
            (u.armature_voltage_v - drop_v) / at(Parameter::kInductance)};
  }

  SpindleMatrix spindle_jacobian(const Cut& tau) const {
    return {-(viscous_friction_nms_rad_ + tau.per_speed) / at(Parameter::kInertia),
            at(Parameter::kTorqueConstant) / at(Parameter::kInertia),
            -at(Parameter::kBackEmfConstant) / at(Parameter::kInductance),
            -at(Parameter::kResistance) / at(Parameter::kInductance)};
  }

  Theta theta_;
  Real viscous_friction_nms_rad_;
  Real feed_viscous_friction_ns_m_;
  Real contact_offset_n_;
  ContactLaw<Real> contact_law_;
};

}  // namespace morepro
