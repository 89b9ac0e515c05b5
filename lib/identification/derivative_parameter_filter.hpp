#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/identification/derivative_rows.hpp"
#include "lib/identification/ud_block.hpp"
#include "lib/math/register_copy.hpp"
#include "lib/plant/machine_parameters.hpp"
#include "lib/plant/parameter.hpp"

namespace morepro {

/// Measured derivatives with their variances, > 0; kUnmeasured says that one is missing.
template <class Real>
struct DerivativeMeasurement {
  Real acceleration_rad_s2{};
  Real feed_acceleration_m_s2{};
  Real current_rate_a_s{};
  Real acceleration_variance{};
  Real feed_acceleration_variance{};
  Real current_rate_variance{};
};

/// The thesis's extended Kalman filter over seven parameters, with the measured derivatives w', v', i' as its
/// outputs and the corrected Jacobian (equation 22). Each output depends on the parameters of its own balance
/// only, so the covariance falls into blocks of 2 + 2 + 3 parameters as soon as the datasheet's errors are
/// independent.
///
/// Literal: it takes every row as it comes. Noise in w, v, i is not modelled, and it does not know when it
/// learns nothing; DerivativeIdentification guards it. The datasheet's values must be > 0. Bounded time; may
/// run in an interrupt.
template <class Real>
class DerivativeParameterFilter {
 public:
  /// `start_fraction`: standard deviation of the datasheet's values, relative, > 0.
  DerivativeParameterFilter(const MachineParameters& machine, Real start_fraction)
      : torque_({static_cast<Real>(machine.spindle.torque_constant_nm_a),
                 static_cast<Real>(machine.spindle.inertia_kgm2)},
                start_fraction),
        force_({static_cast<Real>(machine.feed.mass_kg), static_cast<Real>(machine.feed.contact_force_n)},
               start_fraction),
        voltage_({static_cast<Real>(machine.spindle.inductance_h),
                  static_cast<Real>(machine.spindle.resistance_ohm),
                  static_cast<Real>(machine.spindle.back_emf_constant_vs_rad)},
                 start_fraction),
        spindle_friction_(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        feed_friction_(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        contact_offset_(static_cast<Real>(machine.feed.contact_offset_n)) {}

  [[nodiscard]] DerivativeRow<Real, 2> torque_row(const DerivativeInput<Real>& u) const {
    return morepro::torque_row(torque_.learnt.value, spindle_friction_, u);
  }
  [[nodiscard]] DerivativeRow<Real, 2> force_row(const DerivativeInput<Real>& u) const {
    return morepro::force_row(force_.learnt.value, feed_friction_, contact_offset_, u);
  }
  [[nodiscard]] DerivativeRow<Real, 3> voltage_row(const DerivativeInput<Real>& u) const {
    return morepro::voltage_row(voltage_.learnt.value, u);
  }

  /// One measured derivative; the row may have been changed by the caller (a slope of 0: nothing is learnt
  /// about that parameter here). Variance > 0. A row whose prediction is uncertain by less than `least_share`
  /// of the measurement's variance is not used: it could only turn what is known already.
  void learn_torque(const DerivativeRow<Real, 2>& row, Real acceleration_rad_s2, Real variance,
                    Real least_share = Real(0)) {
    torque_.learnt.learn(row, acceleration_rad_s2, variance, least_share);
  }
  void learn_force(const DerivativeRow<Real, 2>& row, Real acceleration_m_s2, Real variance,
                   Real least_share = Real(0)) {
    force_.learnt.learn(row, acceleration_m_s2, variance, least_share);
  }
  void learn_voltage(const DerivativeRow<Real, 3>& row, Real current_rate_a_s, Real variance,
                     Real least_share = Real(0)) {
    voltage_.learnt.learn(row, current_rate_a_s, variance, least_share);
  }

  /// One frame in which all three are measured.
  void step(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    auto torque = math::loaded(torque_.learnt);
    torque.learn(morepro::torque_row(torque.value, spindle_friction_, u), y.acceleration_rad_s2,
                 y.acceleration_variance);
    math::store(torque_.learnt, torque);
    auto force = math::loaded(force_.learnt);
    force.learn(morepro::force_row(force.value, feed_friction_, contact_offset_, u), y.feed_acceleration_m_s2,
                y.feed_acceleration_variance);
    math::store(force_.learnt, force);
    auto voltage = math::loaded(voltage_.learnt);
    voltage.learn(morepro::voltage_row(voltage.value, u), y.current_rate_a_s, y.current_rate_variance);
    math::store(voltage_.learnt, voltage);
  }

  /// A random walk of one parameter: its variance grows by that of `fraction` of the datasheet's value.
  void drift(Parameter parameter, Real fraction) {
    on_block(*this, parameter, [&](auto& block) {
      const std::size_t j = place_of(parameter);
      const Real deviation = fraction * block.datasheet[j];
      block.learnt.covariance.add_variance(j, deviation * deviation);
    });
  }

  /// The values stay, and are known no better than a datasheet.
  void restart_covariance() {
    torque_.restart_covariance();
    force_.restart_covariance();
    voltage_.restart_covariance();
  }

  /// Back into [1/50, 50] of the datasheet's value.
  void bound(Parameter parameter) {
    on_block(*this, parameter, [&](auto& block) {
      const std::size_t j = place_of(parameter);
      block.learnt.value[j] =
          std::clamp(block.learnt.value[j], Real(0.02) * block.datasheet[j], Real(50) * block.datasheet[j]);
    });
  }

  [[nodiscard]] Real value(Parameter parameter) const {
    Real result{};
    on_block(*this, parameter, [&](const auto& block) { result = block.learnt.value[place_of(parameter)]; });
    return result;
  }
  /// Relative covariance of two parameters, 0 where they belong to different balances.
  [[nodiscard]] Real covariance(Parameter a, Parameter b) const {
    if (balance_of(a) != balance_of(b)) return Real(0);
    Real result{};
    on_block(*this, a, [&](const auto& block) {
      result = block.learnt.covariance.covariance(place_of(a), place_of(b)) /
               (block.learnt.value[place_of(a)] * block.learnt.value[place_of(b)]);
    });
    return result;
  }

 private:
  /// What is known of the parameters of one balance, in one piece: every frame reads and writes it all.
  /// Number `kDivisor` divides its row: a step that would not leave it positive is not taken, so that every
  /// row stays finite.
  template <std::size_t kN, std::size_t kDivisor>
  struct Learnt {
    std::array<Real, kN> value;
    UdBlock<Real, kN> covariance;

    void learn(const DerivativeRow<Real, kN>& row, Real measured, Real variance, Real least_share = Real(0)) {
      if (least_share > Real(0) && covariance.variance_along(row.slope) < least_share * variance) return;
      const auto update = covariance.update(row.slope, variance);
      const Real share = (measured - row.derivative) * update.inverse_variance;
      const Real divisor = value[kDivisor] + update.direction[kDivisor] * share;
      value[kDivisor] = divisor > Real(0) ? divisor : value[kDivisor];
      for (std::size_t j = 0; j < kN; ++j)
        if (j != kDivisor) value[j] += update.direction[j] * share;
    }
  };

  /// The parameters of one balance.
  template <std::size_t kN, std::size_t kDivisor>
  struct Block {
    using Values = std::array<Real, kN>;

    Block(const Values& from, Real start_fraction)
        : learnt{from, UdBlock<Real, kN>(variances(from, start_fraction))},
          datasheet(from),
          start(start_fraction) {}

    void restart_covariance() { learnt.covariance = UdBlock<Real, kN>(variances(datasheet, start)); }

    static Values variances(const Values& from, Real fraction) {
      Values result{};
      for (std::size_t j = 0; j < kN; ++j) result[j] = fraction * from[j] * fraction * from[j];
      return result;
    }

    Learnt<kN, kDivisor> learnt;
    Values datasheet;
    Real start;  ///< relative standard deviation of the datasheet's values
  };

  /// Calls `act` with the block of a parameter.
  template <class Self, class Act>
  static void on_block(Self& self, Parameter parameter, Act act) {
    switch (balance_of(parameter)) {
      case DerivativeBalance::kTorque:
        return act(self.torque_);
      case DerivativeBalance::kForce:
        return act(self.force_);
      case DerivativeBalance::kVoltage:
        return act(self.voltage_);
    }
  }

  Block<2, 1> torque_;
  Block<2, 0> force_;
  Block<3, 0> voltage_;
  Real spindle_friction_;
  Real feed_friction_;
  Real contact_offset_;
};

}  // namespace morepro
