#pragma once
#include <algorithm>
#include <cstdint>
#include <numbers>

#include "lib/math/elementary.hpp"
#include "lib/plant/contact_torque.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// Torque of a cut: tau = beta (kap w + (N0 + N1 CL) r tanh(w/ws)), beta = max(0, speed term - feed term)
/// th(T).
///
/// kConsistent: speed term 3.32 Vc^-0.45 with Vc = 0.03 DC |w| in [70, 230] m/min, feed term 0.24 f with f =
/// t CL in [0.08, 0.47] mm/rev (equation 12 with its units). Outside, Vc and f are clamped and flagged.
/// kThesis: equation 15 to the letter, 3.32 (pi DC ws/1000)^-0.45 and 0.24 t ws CL/1000 with ws = max(|w|, 1
/// rad/s); never flagged. th(T) is equation 16, 1 up to T0 and 0 from Tm on.
///
/// Finite for every finite argument: speeds beyond 1e6 rad/s and chip loads beyond 1000 mm count as that
/// bound. Bounded time, no state: may run in an interrupt.
template <class Real>
class ContactLaw {
 public:
  using Term = ContactTerm<Real>;

  explicit ContactLaw(const MachineParameters& machine)
      : form_(machine.contact.form),
        cutting_speed_scale_(static_cast<Real>(cutting_speed_scale(machine))),
        teeth_(static_cast<Real>(machine.tool.teeth)),
        viscous_gain_nms_(static_cast<Real>(machine.contact.viscous_gain_nms)),
        edge_torque_nm_(static_cast<Real>(machine.contact.edge_force_n * machine.contact.radius_m)),
        chip_torque_nm_mm_(static_cast<Real>(machine.contact.chip_force_n_mm * machine.contact.radius_m)),
        per_speed_scale_(static_cast<Real>(1.0 / machine.contact.speed_scale_rad_s)),
        reference_degc_(static_cast<Real>(machine.thermal.reference_degc)),
        thermal_span_degc_(static_cast<Real>(machine.thermal.melting_degc - machine.thermal.reference_degc)),
        thermal_exponent_(static_cast<Real>(machine.thermal.exponent)) {}

  /// Speed in rad/s (either direction), chip load in mm per tooth, tool temperature in degC.
  ContactTorque<Real> operator()(Real speed_rad_s, Real chip_load_mm, Real tool_temperature_degc) const {
    return at_thermal_factor(speed_rad_s, chip_load_mm, thermal_factor(tool_temperature_degc));
  }

  /// The same for a thermal factor that is known already: it is one power for all hypotheses of a bank.
  ContactTorque<Real> at_thermal_factor(Real speed_rad_s, Real chip_load_mm, Real factor) const {
    const Real w = std::clamp(speed_rad_s, -kFastest, kFastest);
    const Real chip = std::clamp(chip_load_mm, -kThickest, kThickest);
    const Term beta = friction(w, chip, factor);
    const Term arm = lever(w, chip);
    ContactTorque<Real> torque{.torque_nm = beta.value * arm.value, .beta = beta.value, .flags = beta.flags};
    if (w == speed_rad_s) torque.per_speed = beta.per_speed * arm.value + beta.value * arm.per_speed;
    if (chip == chip_load_mm)
      torque.per_chip_load = beta.per_chip_load * arm.value + beta.value * arm.per_chip_load;
    return torque;
  }

  /// th(T) in [0, 1].
  Real thermal_factor(Real tool_temperature_degc) const {
    const Real above = (tool_temperature_degc - reference_degc_) / thermal_span_degc_;
    return Real(1) - math::pow(std::clamp(above, Real(0), Real(1)), thermal_exponent_);
  }

  /// 3.32 Vc^-0.45, with its slope by speed. |speed_rad_s| <= 1e6.
  Term speed_term(Real speed_rad_s) const {
    const Real size = math::abs(speed_rad_s);
    Term term;
    const Real cutting_speed = clamped_cutting_speed(size, term.flags);
    term.value = Real(3.32) * math::pow(cutting_speed, Real(-0.45));
    const bool is_clamped = form_ == ContactForm::kThesis ? size < kSlowest : term.flags != 0;
    if (!is_clamped) term.per_speed = Real(-0.45) * term.value / speed_rad_s;
    return term;
  }

  /// 0.24 f, with its slopes. |speed_rad_s| <= 1e6; only kThesis depends on it.
  Term feed_term(Real speed_rad_s, Real chip_load_mm) const {
    return form_ == ContactForm::kThesis ? thesis_feed_term(speed_rad_s, chip_load_mm)
                                         : consistent_feed_term(chip_load_mm);
  }

  /// beta: (speed term - feed term) times the thermal factor, not below 0.
  Term friction(Real speed_rad_s, Real chip_load_mm, Real factor) const {
    const Term speed = speed_term(speed_rad_s);
    const Term feed = feed_term(speed_rad_s, chip_load_mm);
    Term beta{.flags = static_cast<std::uint8_t>(speed.flags | feed.flags)};
    const Real difference = speed.value - feed.value;
    if (!(difference > Real(0))) return beta;
    beta.value = difference * factor;
    beta.per_speed = (speed.per_speed - feed.per_speed) * factor;
    beta.per_chip_load = -feed.per_chip_load * factor;
    return beta;
  }

  /// kap w + (N0 + N1 CL) r tanh(w/ws) in N m: the torque per unit of beta, with its slopes.
  Term lever(Real speed_rad_s, Real chip_load_mm) const {
    const Real side = math::tanh(speed_rad_s * per_speed_scale_);
    const Real normal = edge_torque_nm_ + chip_torque_nm_mm_ * chip_load_mm;
    return {.value = viscous_gain_nms_ * speed_rad_s + normal * side,
            .per_speed = viscous_gain_nms_ + normal * (Real(1) - side * side) * per_speed_scale_,
            .per_chip_load = chip_torque_nm_mm_ * side};
  }

  /// Cutting speed of the law in m/min per rad/s of spindle speed.
  Real cutting_speed_scale() const { return cutting_speed_scale_; }

 private:
  static constexpr Real kFastest = Real(1.0e6);
  static constexpr Real kThickest = Real(1000);
  static constexpr Real kSlowest = Real(1);  ///< floor of kThesis in rad/s: its power is infinite at rest

  static double cutting_speed_scale(const MachineParameters& machine) {
    const bool is_thesis = machine.contact.form == ContactForm::kThesis;
    return is_thesis ? std::numbers::pi * machine.tool.diameter_mm / 1000.0 : 0.03 * machine.tool.diameter_mm;
  }

  Real clamped_cutting_speed(Real size, std::uint8_t& flags) const {
    if (form_ == ContactForm::kThesis) return cutting_speed_scale_ * std::max(size, kSlowest);
    constexpr Real kLow = Real(ContactRange::kLowestCuttingSpeed);
    constexpr Real kHigh = Real(ContactRange::kHighestCuttingSpeed);
    const Real cutting_speed = cutting_speed_scale_ * size;
    if (cutting_speed < kLow) flags = bits_of(ContactFlag::kCuttingSpeedLow);
    if (cutting_speed > kHigh) flags = bits_of(ContactFlag::kCuttingSpeedHigh);
    return std::clamp(cutting_speed, kLow, kHigh);
  }

  Term thesis_feed_term(Real speed_rad_s, Real chip_load_mm) const {
    const Real size = math::abs(speed_rad_s);
    const Real per_chip = Real(0.24) * teeth_ * std::max(size, kSlowest) * Real(1.0e-3);
    Term term{.value = per_chip * chip_load_mm, .per_chip_load = per_chip};
    if (size > kSlowest) term.per_speed = term.value / speed_rad_s;
    return term;
  }

  Term consistent_feed_term(Real chip_load_mm) const {
    constexpr Real kLow = Real(ContactRange::kLowestFeed);
    constexpr Real kHigh = Real(ContactRange::kHighestFeed);
    const Real feed = teeth_ * chip_load_mm;
    Term term{.value = Real(0.24) * std::clamp(feed, kLow, kHigh)};
    if (feed < kLow) term.flags = bits_of(ContactFlag::kFeedLow);
    if (feed > kHigh) term.flags = bits_of(ContactFlag::kFeedHigh);
    if (term.flags == 0) term.per_chip_load = Real(0.24) * teeth_;
    return term;
  }

  ContactForm form_;
  Real cutting_speed_scale_;
  Real teeth_;
  Real viscous_gain_nms_;
  Real edge_torque_nm_;
  Real chip_torque_nm_mm_;
  Real per_speed_scale_;
  Real reference_degc_;
  Real thermal_span_degc_;
  Real thermal_exponent_;
};

/// Is a chip load inside the range that the machine's law was fitted in? Always for kThesis, whose range the
/// thesis leaves itself. Tolerates the last bits of a bound: 0.47/4 mm is inside.
constexpr bool is_inside_contact_range(const MachineParameters& machine, double chip_load_mm) {
  if (machine.contact.form == ContactForm::kThesis) return chip_load_mm > 0.0;
  constexpr double kSlack = 1.0e-9;
  const double feed = machine.tool.teeth * chip_load_mm;
  return feed >= ContactRange::kLowestFeed * (1.0 - kSlack) &&
         feed <= ContactRange::kHighestFeed * (1.0 + kSlack);
}

}  // namespace morepro
