#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/plant/parameter.hpp"

namespace morepro {

/// The rows of equation 22: w', v', i'.
enum class DerivativeBalance : std::uint8_t { kTorque, kForce, kVoltage };

/// The row that a parameter stands in, and its place among that row's parameters.
constexpr DerivativeBalance balance_of(Parameter parameter) {
  return parameter <= Parameter::kInertia        ? DerivativeBalance::kTorque
         : parameter <= Parameter::kContactForce ? DerivativeBalance::kForce
                                                 : DerivativeBalance::kVoltage;
}
constexpr std::size_t place_of(Parameter parameter) {
  const std::size_t j = index_of(parameter);
  return j < 2 ? j : j < 4 ? j - 2 : j - 4;
}

/// What the three balances are evaluated with, all at one instant.
template <class Real>
struct DerivativeInput {
  Real speed_rad_s{};
  Real feed_speed_m_s{};
  Real current_a{};
  Real armature_voltage_v{};
  Real feed_force_n{};
  Real contact{};  ///< 0 or 1
  Real engagement = Real(1);
  Real contact_torque_nm{};  ///< of ContactLaw, 0 without contact
};

/// A predicted derivative and its slopes by the parameters of its own balance.
template <class Real, std::size_t kN>
struct DerivativeRow {
  Real derivative{};
  std::array<Real, kN> slope{};
};

/// Row w' of equation 22: slopes by torque constant and inertia, both > 0. Unit rad/s2.
template <class Real>
DerivativeRow<Real, 2> torque_row(const std::array<Real, 2>& theta, Real viscous_friction_nms_rad,
                                  const DerivativeInput<Real>& u) {
  const auto [torque_constant, inertia] = theta;
  const Real per_inertia = Real(1) / inertia;
  const Real torque =
      torque_constant * u.current_a - viscous_friction_nms_rad * u.speed_rad_s - u.contact_torque_nm;
  const Real derivative = torque * per_inertia;
  return {derivative, {u.current_a * per_inertia, -derivative * per_inertia}};
}

/// Row v' of equation 22: slopes by mass > 0 and contact force. The print multiplies the slope by the mass
/// with the contact in the wrong place, which is right for contact 1 only; -v'/m holds for both. Unit m/s2.
template <class Real>
DerivativeRow<Real, 2> force_row(const std::array<Real, 2>& theta, Real viscous_friction_ns_m,
                                 Real contact_offset_n, const DerivativeInput<Real>& u) {
  const auto [mass, contact_force] = theta;
  const Real per_mass = Real(1) / mass;
  const Real cutting = u.contact * (contact_force * u.engagement + contact_offset_n);
  const Real derivative = (u.feed_force_n - viscous_friction_ns_m * u.feed_speed_m_s - cutting) * per_mass;
  return {derivative, {-derivative * per_mass, -u.contact * u.engagement * per_mass}};
}

/// Row i' of equation 22: slopes by inductance > 0, resistance and back-EMF constant. Unit A/s.
template <class Real>
DerivativeRow<Real, 3> voltage_row(const std::array<Real, 3>& theta, const DerivativeInput<Real>& u) {
  const auto [inductance, resistance, back_emf_constant] = theta;
  const Real per_inductance = Real(1) / inductance;
  const Real drop = resistance * u.current_a + back_emf_constant * u.speed_rad_s;
  const Real derivative = (u.armature_voltage_v - drop) * per_inductance;
  return {derivative,
          {-derivative * per_inductance, -u.current_a * per_inductance, -u.speed_rad_s * per_inductance}};
}

}  // namespace morepro
