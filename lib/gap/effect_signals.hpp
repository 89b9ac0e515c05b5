#pragma once
#include <type_traits>

#include "lib/gap/angle_multiples.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::gap {

/// Where so many terms are tried that what they have in common is worked out once: on a PC, which counts in
/// double.
template <class Real>
inline constexpr bool kMayShare = std::is_same_v<Real, double>;
struct Nothing {};

/// What an effect can depend on, at one instant. SI units, temperatures in degC, chip load in mm.
template <class Real>
struct EffectSignals {
  Real time_s = 0;          ///< since the recording began
  Real cutting_time_s = 0;  ///< of it, spent in contact
  Real armature_voltage_v = 0;
  Real feed_force_n = 0;
  Real contact = 0;
  Real chip_load_mm = 0;
  Real speed_rad_s = 0;
  Real angle_rad = 0;
  Real current_a = 0;
  Real feed_speed_m_s = 0;
  Real feed_position_m = 0;  ///< from where the axis stood at first
  Real tool_degc = 0;
  Real winding_degc = 0;
  Real acceleration_rad_s2 = 0;  ///< of the nominal model
  Real current_rate_a_s = 0;     ///< of the nominal model
  // The same speeds and current as far as inputs and laws made them change: what is measured at random lags
  // too, but would take the blame for every disturbance that lasts.
  Real driven_speed_rad_s = 0;
  Real driven_current_a = 0;
  Real driven_feed_speed_m_s = 0;
  /// Of `angle_rad`, where many terms follow it; none: each for itself.
  [[no_unique_address]] std::conditional_t<kMayShare<Real>, const AngleMultiples<Real>*, Nothing> multiples{};
};

/// What one effect adds, for a coefficient of one: to the right-hand side of the balances,
///   In dw/dt = ... + torque,   m dv/dt = ... + force,   L di/dt = ... + voltage,
/// and to what the sensors show: measured = true + speed, and so on.
template <class Real>
struct Contribution {
  Real torque_nm = 0;
  Real force_n = 0;
  Real voltage_v = 0;
  Real speed_rad_s = 0;
  Real current_a = 0;
  Real feed_speed_m_s = 0;
};

/// Points at which effects are normalised, so that their sizes are numbers that an engineer can place.
struct ReferencePoint {
  double speed_rad_s = 0.0;     ///< of the steady cut
  double current_a = 0.0;       ///< of the steady cut
  double feed_speed_m_s = 0.0;  ///< of the steady cut
  double chip_load_mm = 0.0;    ///< nominal
  double tool_degc = 0.0;       ///< nominal
  double winding_degc = 25.0;   ///< at which resistance and flux are specified
  double feed_force_n = 1.0;    ///< usual size
  double travel_from_m = 0.0;   ///< lowest place of the axis, from where it stood at first
  double travel_m = 1.0;        ///< way between its lowest and highest place
};

}  // namespace morepro::gap
