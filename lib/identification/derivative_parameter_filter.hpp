#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/estimation/spindle_signals.hpp"
#include "lib/identification/derivative_rows.hpp"
#include "lib/identification/ud_block.hpp"
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
/// outputs and the corrected Jacobian (equation 22). Each output depends on the parameters of its own balance only,
/// so the covariance falls into blocks of 2 + 2 + 3 parameters as soon as the datasheet's errors are independent.
///
/// Literal: it takes every row as it comes. Noise in w, v, i is not modelled, and it does not know when it learns
/// nothing; DerivativeIdentification guards it. Parameters stay in [1/50, 50] of the datasheet's values, which must be
/// > 0. Bounded time; may run in an interrupt.
template <class Real>
class DerivativeParameterFilter {
 public:
  /// `start_fraction`: standard deviation of the datasheet's values, relative, > 0.
  DerivativeParameterFilter(const MachineParameters& machine, Real start_fraction)
      : spindle_friction_(static_cast<Real>(machine.spindle.viscous_friction_nms_rad)),
        feed_friction_(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        contact_offset_(static_cast<Real>(machine.feed.contact_offset_n)),
        torque_({static_cast<Real>(machine.spindle.torque_constant_nm_a),
                 static_cast<Real>(machine.spindle.inertia_kgm2)},
                start_fraction),
        force_({static_cast<Real>(machine.feed.mass_kg), static_cast<Real>(machine.feed.contact_force_n)},
               start_fraction),
        voltage_({static_cast<Real>(machine.spindle.inductance_h),
                  static_cast<Real>(machine.spindle.resistance_ohm),
                  static_cast<Real>(machine.spindle.back_emf_constant_vs_rad)},
                 start_fraction) {}

  [[nodiscard]] DerivativeRow<Real, 2> torque_row(const DerivativeInput<Real>& u) const {
    return morepro::torque_row(torque_.value, spindle_friction_, u);
  }
  [[nodiscard]] DerivativeRow<Real, 2> force_row(const DerivativeInput<Real>& u) const {
    return morepro::force_row(force_.value, feed_friction_, contact_offset_, u);
  }
  [[nodiscard]] DerivativeRow<Real, 3> voltage_row(const DerivativeInput<Real>& u) const {
    return morepro::voltage_row(voltage_.value, u);
  }

  /// One measured derivative; the row may have been changed by the caller (a slope of 0: nothing is learnt about that
  /// parameter here). Variance > 0.
  void learn_torque(const DerivativeRow<Real, 2>& row, Real acceleration_rad_s2, Real variance) {
    torque_.learn(row, acceleration_rad_s2, variance);
  }
  void learn_force(const DerivativeRow<Real, 2>& row, Real acceleration_m_s2, Real variance) {
    force_.learn(row, acceleration_m_s2, variance);
  }
  void learn_voltage(const DerivativeRow<Real, 3>& row, Real current_rate_a_s, Real variance) {
    voltage_.learn(row, current_rate_a_s, variance);
  }

  /// One frame in which all three are measured.
  void step(const DerivativeInput<Real>& u, const DerivativeMeasurement<Real>& y) {
    learn_torque(torque_row(u), y.acceleration_rad_s2, y.acceleration_variance);
    learn_force(force_row(u), y.feed_acceleration_m_s2, y.feed_acceleration_variance);
    learn_voltage(voltage_row(u), y.current_rate_a_s, y.current_rate_variance);
  }

  /// A random walk of one parameter: its variance grows by that of `fraction` of the datasheet's value.
  void drift(Parameter parameter, Real fraction) {
    on_block(parameter, [&](auto& block, std::size_t j) {
      const Real deviation = fraction * block.datasheet[j];
      block.covariance.add_variance(j, deviation * deviation);
    });
  }

  [[nodiscard]] Real value(Parameter parameter) const {
    Real result{};
    on_block(parameter, [&](const auto& block, std::size_t j) { result = block.value[j]; });
    return result;
  }
  /// Relative to the squared value.
  [[nodiscard]] Real variance(Parameter parameter) const {
    Real result{};
    on_block(parameter, [&](const auto& block, std::size_t j) {
      result = block.covariance.covariance(j, j) / (block.value[j] * block.value[j]);
    });
    return result;
  }

 private:
  /// The parameters of one balance; number `kDivisor` divides its row: a step that would not leave it positive is not
  /// taken.
  template <std::size_t kN, std::size_t kDivisor>
  struct Block {
    using Values = std::array<Real, kN>;

    Block(const Values& from, Real start_fraction)
        : datasheet(from), value(from), covariance(variances(from, start_fraction)) {}

    void learn(const DerivativeRow<Real, kN>& row, Real measured, Real variance) {
      const auto update = covariance.update(row.slope, variance);
      const Real share = (measured - row.derivative) * update.inverse_variance;
      const Real divisor = value[kDivisor] + update.direction[kDivisor] * share;
      if (divisor > Real(0)) value[kDivisor] = divisor;
      for (std::size_t j = 0; j < kN; ++j)
        if (j != kDivisor) value[j] += update.direction[j] * share;
    }

    static Values variances(const Values& from, Real fraction) {
      Values result{};
      for (std::size_t j = 0; j < kN; ++j) result[j] = fraction * from[j] * fraction * from[j];
      return result;
    }

    Values datasheet;
    Values value;
    UdBlock<Real, kN> covariance;
  };

  /// Calls `act` with the block of a parameter and its place there.
  template <class Act>
  void on_block(Parameter parameter, Act act) {
    visit(*this, parameter, act);
  }
  template <class Act>
  void on_block(Parameter parameter, Act act) const {
    visit(*this, parameter, act);
  }
  template <class Self, class Act>
  static void visit(Self& self, Parameter parameter, Act act) {
    switch (parameter) {
      case Parameter::kTorqueConstant:
        return act(self.torque_, 0);
      case Parameter::kInertia:
        return act(self.torque_, 1);
      case Parameter::kMass:
        return act(self.force_, 0);
      case Parameter::kContactForce:
        return act(self.force_, 1);
      case Parameter::kInductance:
        return act(self.voltage_, 0);
      case Parameter::kResistance:
        return act(self.voltage_, 1);
      case Parameter::kBackEmfConstant:
        return act(self.voltage_, 2);
    }
  }

  Real spindle_friction_;
  Real feed_friction_;
  Real contact_offset_;
  Block<2, 1> torque_;
  Block<2, 0> force_;
  Block<3, 0> voltage_;
};

}  // namespace morepro
