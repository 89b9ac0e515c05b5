#pragma once
#include <cstdint>
#include <limits>
#include <numbers>

#include "lib/plant/contact_law.hpp"

namespace morepro {

/// Where a friction model left its range; the low four bits are those of ContactFlag.
enum class FrictionFlag : std::uint8_t {
  kBelowReference = 16,  ///< colder than T0: the thermal factor is 1
  kAboveMelting = 32,    ///< hotter than Tm: the thermal factor is 0
  kNegative = 64,        ///< the model's difference is below 0, friction that would drive: 0 is given
  kNotANumber = 128,     ///< an argument is not finite: 0 is given
};

constexpr std::uint8_t bits_of(FrictionFlag flag) { return static_cast<std::uint8_t>(flag); }

/// A friction coefficient and what is to be said about it.
template <class Real>
struct Friction {
  Real beta = 0;           ///< >= 0, finite
  std::uint8_t flags = 0;  ///< ContactFlag and FrictionFlag bits
};

/// The friction models of the thesis's sections 4.2.2 and 4.3 side by side, in the form of the machine's
/// contact law (consistent or literal): by machining speeds, by temperature, and their product, which the
/// contact law uses. (The model by cutting forces, 4.2.1, is in cutting_force.hpp.) Always finite; bounded
/// time, no memory: may run in an interrupt.
template <class Real>
class FrictionModels {
 public:
  /// [beta0] of equation 16.
  static constexpr Real kCold = Real(std::numbers::inv_sqrt3);

  explicit FrictionModels(const MachineParameters& machine)
      : law_(machine),
        reference_degc_(static_cast<Real>(machine.thermal.reference_degc)),
        melting_degc_(static_cast<Real>(machine.thermal.melting_degc)) {}

  /// Equation 12 by the consistent law, equation 15 by the literal one: spindle speed in rad/s, chip load in
  /// mm.
  Friction<Real> machining_speed(Real speed_rad_s, Real chip_load_mm) const {
    return of_speed(speed_rad_s, chip_load_mm, Real(1));
  }

  /// Equation 16: 1/sqrt(3) th(T), tool temperature in degC.
  Friction<Real> temperature(Real tool_temperature_degc) const {
    if (!is_finite(tool_temperature_degc)) return not_a_number();
    return {kCold * law_.thermal_factor(tool_temperature_degc), thermal_flags(tool_temperature_degc)};
  }

  /// Equation 17: the model of the machining speeds times th(T).
  Friction<Real> product(Real speed_rad_s, Real chip_load_mm, Real tool_temperature_degc) const {
    if (!is_finite(tool_temperature_degc)) return not_a_number();
    Friction<Real> friction = of_speed(speed_rad_s, chip_load_mm, law_.thermal_factor(tool_temperature_degc));
    friction.flags = static_cast<std::uint8_t>(friction.flags | thermal_flags(tool_temperature_degc));
    return friction;
  }

 private:
  static bool is_finite(Real x) { return math::abs(x) <= std::numeric_limits<Real>::max(); }
  static Friction<Real> not_a_number() { return {Real(0), bits_of(FrictionFlag::kNotANumber)}; }

  Friction<Real> of_speed(Real speed_rad_s, Real chip_load_mm, Real factor) const {
    if (!is_finite(speed_rad_s) || !is_finite(chip_load_mm)) return not_a_number();
    const ContactTorque<Real> cut = law_.at_thermal_factor(speed_rad_s, chip_load_mm, factor);
    const bool is_negative = cut.beta == Real(0) && factor > Real(0);
    const auto negative = is_negative ? bits_of(FrictionFlag::kNegative) : std::uint8_t{0};
    return {cut.beta, static_cast<std::uint8_t>(cut.flags | negative)};
  }

  std::uint8_t thermal_flags(Real tool_temperature_degc) const {
    if (tool_temperature_degc < reference_degc_) return bits_of(FrictionFlag::kBelowReference);
    return tool_temperature_degc > melting_degc_ ? bits_of(FrictionFlag::kAboveMelting) : std::uint8_t{0};
  }

  ContactLaw<Real> law_;
  Real reference_degc_;
  Real melting_degc_;
};

}  // namespace morepro
