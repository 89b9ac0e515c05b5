#pragma once
#include <array>
#include <cstddef>

#include "lib/math/matrix_exponential.hpp"
#include "lib/plant/contact_torque.hpp"

namespace morepro {

/// The spindle at one estimate: derivatives and their Jacobian. Parameters in the order of SpindleParameter.
template <class Real>
struct SpindleRates {
  Real dw, di;
  math::BasicMatrix2<Real> a;

  template <class Values>
  SpindleRates(const Values& value, Real viscous_friction, const ContactTorque<Real>& contact, Real w, Real i,
               Real voltage) {
    const Real kt = value[0], resistance = value[3], kv = value[4];
    const Real per_inertia = Real(1) / value[1], per_inductance = Real(1) / value[2];
    dw = (kt * i - viscous_friction * w - contact.torque_nm) * per_inertia;
    di = (voltage - resistance * i - kv * w) * per_inductance;
    a = {-(viscous_friction + contact.per_speed) * per_inertia, kt * per_inertia, -kv * per_inductance,
         -resistance * per_inductance};
  }
};

/// Integral of exp(A s) over one period, by its series to the fourth term: 4e-4 of the change in one period
/// where the electrical time constant is two periods, 1 % where it is one, which is the least that is
/// reported.
template <class Real>
math::BasicMatrix2<Real> held_response(const math::BasicMatrix2<Real>& a, Real period_s) {
  const auto z = a * period_s;
  auto series = (z * Real(0.25)).plus_identity();
  series = (z * series * Real(1.0 / 3.0)).plus_identity();
  series = (z * series * Real(0.5)).plus_identity();
  return series * period_s;
}

/// What the slopes of the spindle by its parameters are made of.
template <class Real>
struct SpindleRegressors {
  Real w, i, dw, di;
};

/// Change of [w, i] in one period by the logarithms of the parameters, `phi` from held_response.
template <class Real, std::size_t kN>
std::array<std::array<Real, kN>, 2> spindle_slopes(const std::array<Real, kN>& value, Real viscous_friction,
                                                   const SpindleRegressors<Real>& r,
                                                   const math::BasicMatrix2<Real>& phi) {
  const Real per_inertia = Real(1) / value[1], per_inductance = Real(1) / value[2];
  constexpr std::size_t kInductance = 2, kBackEmfConstant = 4, kFriction = 5;
  std::array<Real, kN> slope{value[0] * r.i * per_inertia, -r.dw, -r.di, -value[3] * r.i * per_inductance,
                             -value[4] * r.w * per_inductance};
  if constexpr (kN > kFriction) slope[kFriction] = -viscous_friction * r.w * per_inertia;
  std::array<std::array<Real, kN>, 2> g;
  for (std::size_t j = 0; j < kN; ++j) {
    const bool is_electrical = j >= kInductance && j <= kBackEmfConstant;
    g[0][j] = (is_electrical ? phi.a01 : phi.a00) * slope[j];
    g[1][j] = (is_electrical ? phi.a11 : phi.a10) * slope[j];
  }
  return g;
}

/// The feed axis over one period: how much of its speed stays, and what an acceleration at the period's
/// beginning adds to its speed and to its position, by the same series. `friction_rate`: viscous friction
/// over mass, 1/s.
template <class Real>
struct FeedResponse {
  Real kept, per_acceleration, way_per_acceleration;

  FeedResponse(Real friction_rate, Real period_s) {
    const Real decay = friction_rate * period_s, half = Real(0.5) * period_s;
    const Real third = Real(1) - Real(1.0 / 3.0) * decay * (Real(1) - Real(0.25) * decay);
    per_acceleration = period_s - half * decay * third;
    way_per_acceleration = half * period_s * third;
    kept = Real(1) - friction_rate * per_acceleration;
  }
};

}  // namespace morepro
