#pragma once

namespace morepro {

/// What moves: spindle speed [w], feed speed [v], armature current [i].
template <class Real>
struct PlantState {
  Real speed_rad_s = 0;
  Real feed_speed_m_s = 0;
  Real current_a = 0;
};

/// Time derivatives of PlantState.
template <class Real>
struct PlantDerivative {
  Real acceleration_rad_s2 = 0;
  Real feed_acceleration_m_s2 = 0;
  Real current_rate_a_s = 0;
};

/// What drives the plant; held over one step.
template <class Real>
struct PlantInput {
  Real armature_voltage_v = 0;     ///< [V]
  Real feed_force_n = 0;           ///< [F1]
  Real contact = 0;                ///< [Fc] 0 or 1
  Real engagement = 1;             ///< [alpha]
  Real chip_load_mm = 0;           ///< [CL] feed per tooth
  Real tool_temperature_degc = 0;  ///< [T]
};

/// Rows and columns of the plant's matrices.
enum PlantIndex : int { kSpeedIndex = 0, kFeedSpeedIndex = 1, kCurrentIndex = 2 };
inline constexpr int kPlantStates = 3;

}  // namespace morepro
