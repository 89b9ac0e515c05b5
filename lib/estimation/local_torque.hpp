#pragma once
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"
#include "lib/plant/contact_law.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// The contact torque of every hypothesis as a cubic in the distance d = w - centre, without the thermal
/// factor: tau_j = thermal * (c0 + d (c1 + d (c2 + d c3))). One power per hypothesis bank instead of one per
/// hypothesis and frame. Relative error < 6e-7 for |d| <= domain(), the next Taylor term of w^-0.45; 4e-8 for
/// half of it.
///
/// It exists only where the law is smooth over the whole domain: the sliding direction saturated, the cutting
/// speed not crossing an edge of the law's box, no hypothesis reaching zero friction. Elsewhere build() says
/// false and the caller evaluates the law itself.
template <class Real, std::size_t kN>
class LocalTorque {
 public:
  using Lanes = std::array<Real, kN>;

  LocalTorque(const MachineParameters& machine, const Lanes& chip_load_mm) : law_(machine) {
    const auto& contact = machine.contact;
    viscous_gain_ = static_cast<Real>(contact.viscous_gain_nms);
    saturated_speed_ = static_cast<Real>(kSaturation * contact.speed_scale_rad_s);
    for (std::size_t j = 0; j < kN; ++j) {
      const double normal_n =
          contact.edge_force_n + contact.chip_force_n_mm * static_cast<double>(chip_load_mm[j]);
      lever_[j] = static_cast<Real>(normal_n * contact.radius_m);
      // The feed term is a constant or proportional to the speed: one point gives both.
      const auto feed = law_.feed_term(Real(2), chip_load_mm[j]);
      beta_slope_[j] = feed.per_speed;
      beta_offset_[j] = feed.value - Real(2) * feed.per_speed;
    }
  }

  /// Half-width of the domain [rad/s] around `centre`.
  static Real domain(Real centre_rad_s) {
    const Real relative = math::abs(centre_rad_s) * Real(kRelativeDomain);
    return relative > Real(kSmallestDomain) ? relative : Real(kSmallestDomain);
  }

  /// Builds the cubics around `centre_rad_s`; false: the law is not smooth there.
  bool build(Real centre_rad_s) {
    const Real speed = math::abs(centre_rad_s);
    const Real low = speed - domain(speed);
    const Real high = speed + domain(speed);
    if (!(low > saturated_speed_ && speed * Real(kRelativeDomain) >= Real(kSmallestDomain))) return false;
    if (law_.speed_term(low).flags != law_.speed_term(high).flags) return false;
    const SpeedSeries series = speed_series(speed);
    bool smooth = true;
    for (std::size_t j = 0; j < kN; ++j) smooth = build_lane(j, speed, series, low, high) && smooth;
    if (centre_rad_s < Real(0)) mirror();
    return smooth;
  }

  const Lanes& c0() const { return c0_; }
  const Lanes& c1() const { return c1_; }
  const Lanes& c2() const { return c2_; }
  const Lanes& c3() const { return c3_; }

 private:
  static constexpr double kRelativeDomain = 0.04;
  static constexpr double kSmallestDomain = 1.0;
  static constexpr double kSaturation = 9.1;  // tanh is 1 to float precision

  /// Taylor coefficients of the law's speed term around one speed.
  struct SpeedSeries {
    Real a0, a1, a2, a3;
  };

  SpeedSeries speed_series(Real speed) const {
    const auto term = law_.speed_term(speed);
    const Real a0 = term.value;
    if (term.flags != 0) return {a0, Real(0), Real(0), Real(0)};
    const Real inverse = Real(1) / speed;
    const Real a1 = Real(-0.45) * a0 * inverse;
    const Real a2 = Real(-1.45 / 2.0) * a1 * inverse;
    return {a0, a1, a2, Real(-2.45 / 3.0) * a2 * inverse};
  }

  /// Product of the friction's cubic and the lever's line; the fourth power is below the series' own error.
  bool build_lane(std::size_t j, Real speed, const SpeedSeries& a, Real low, Real high) {
    const Real b0 = a.a0 - beta_offset_[j] - beta_slope_[j] * speed;
    const Real b1 = a.a1 - beta_slope_[j];
    const Real lever = lever_[j] + viscous_gain_ * speed;
    c0_[j] = b0 * lever;
    c1_[j] = b1 * lever + b0 * viscous_gain_;
    c2_[j] = a.a2 * lever + b1 * viscous_gain_;
    c3_[j] = a.a3 * lever + a.a2 * viscous_gain_;
    const Real beta_low = beta_at(a, b0, b1, low - speed);
    const Real beta_high = beta_at(a, b0, b1, high - speed);
    if (beta_low < Real(0) && beta_high < Real(0)) return clear_lane(j);
    return beta_low > Real(0) && beta_high > Real(0);
  }

  static Real beta_at(const SpeedSeries& a, Real b0, Real b1, Real d) {
    return b0 + d * (b1 + d * (a.a2 + d * a.a3));
  }

  bool clear_lane(std::size_t j) {
    c0_[j] = c1_[j] = c2_[j] = c3_[j] = Real(0);
    return true;
  }

  /// The torque is odd in the speed.
  void mirror() {
    for (std::size_t j = 0; j < kN; ++j) {
      c0_[j] = -c0_[j];
      c2_[j] = -c2_[j];
    }
  }

  ContactLaw<Real> law_;
  Real viscous_gain_{};
  Real saturated_speed_{};
  Lanes lever_{}, beta_offset_{}, beta_slope_{};
  Lanes c0_{}, c1_{}, c2_{}, c3_{};
};

}  // namespace morepro
