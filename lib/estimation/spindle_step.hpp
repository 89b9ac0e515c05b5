#pragma once
#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// Exact discretisation of the linear part of the spindle's electrical-mechanical block over one sampling
/// period, inputs held (physics: dw = (Kt i - Att w - tau)/In, di = (V - R i - Kv w)/L).
///   w+ = ww w + wi i + w_per_v V + w_per_nm tau
///   i+ = iw w + ii i + i_per_v V + i_per_nm tau
/// The contact torque tau [N m] is the only nonlinear term and is added by the filters.
template <class Real>
struct SpindleStep {
  Real ww, wi, iw, ii;
  Real w_per_v, i_per_v;
  Real w_per_nm, i_per_nm;
};

/// `period_s` > 0. Computed in double with + - * / only: the same coefficients on every machine.
template <class Real>
SpindleStep<Real> make_spindle_step(const MachineParameters::Spindle& spindle, double period_s) {
  const math::Matrix2 a{-spindle.viscous_friction_nms_rad / spindle.inertia_kgm2,
                        spindle.torque_constant_nm_a / spindle.inertia_kgm2,
                        -spindle.back_emf_constant_vs_rad / spindle.inductance_h,
                        -spindle.resistance_ohm / spindle.inductance_h};
  const auto step = math::exponential_step(a, period_s);
  const auto& phi = step.exp;
  const auto& psi = step.integral;
  return {static_cast<Real>(phi.a00),
          static_cast<Real>(phi.a01),
          static_cast<Real>(phi.a10),
          static_cast<Real>(phi.a11),
          static_cast<Real>(psi.a01 / spindle.inductance_h),
          static_cast<Real>(psi.a11 / spindle.inductance_h),
          static_cast<Real>(-psi.a00 / spindle.inertia_kgm2),
          static_cast<Real>(-psi.a10 / spindle.inertia_kgm2)};
}

}  // namespace morepro
