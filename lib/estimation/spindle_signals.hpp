#pragma once

namespace morepro {

/// Inputs of the spindle that were held over the period that ends with the present frame.
template <class Real>
struct SpindleInput {
  Real armature_voltage_v{};
  Real contact{};                 ///< 0 or 1
  Real thermal_factor = Real(1);  ///< th(T) of the contact law, 0..1: one power per frame for all filters
};

/// So large that an update with it changes nothing to float precision, so small that its square is finite.
inline constexpr float kUnmeasured = 1.0e12F;

/// Measurements at the present frame. A variance of kUnmeasured says that the channel is missing; its value
/// is then not used.
template <class Real>
struct SpindleMeasurement {
  Real speed_rad_s{};
  Real current_a{};
  Real speed_variance{};
  Real current_variance{};

  [[nodiscard]] bool has_speed() const { return speed_variance < Real(kUnmeasured); }
  [[nodiscard]] bool has_current() const { return current_variance < Real(kUnmeasured); }
};

}  // namespace morepro
