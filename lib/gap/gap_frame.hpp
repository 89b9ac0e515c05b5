#pragma once
#include "lib/plant/plant_state.hpp"

namespace morepro::gap {

/// One sampling interval as the observers see it: inputs held over it, and what was measured at its
/// beginning.
template <class Real>
struct GapFrame {
  Real time_s = 0;
  Real cutting_time_s = 0;
  PlantInput<Real> input;
  Real winding_degc = 0;
  Real speed_rad_s = 0;
  Real current_a = 0;
  Real angle_rad = 0;
  Real feed_speed_m_s = 0;
  Real feed_position_m = 0;
  bool has_speed = false;
  bool has_current = false;
  bool has_angle = false;
  bool has_feed_speed = false;
  bool has_feed_position = false;
};

/// Variances of the sensors, and what the observers allow the machine to do at random in one interval:
/// standard deviations that the interval adds to the states.
template <class Real>
struct GapNoise {
  Real speed_variance = 1;
  Real current_variance = 1;
  Real feed_speed_variance = 1;
  Real feed_position_variance = 1;
  Real free_from_s =
      Real(1.0e30);       ///< from this time on the model runs free: measurements are compared, not taken
  Real speed_step = 0;    ///< rad/s
  Real current_step = 0;  ///< A
  Real feed_step = 0;     ///< m/s

  /// What a sensor's variance is multiplied by at a time.
  [[nodiscard]] Real doubt(Real time_s) const { return time_s < free_from_s ? Real(1) : Real(1.0e12); }
};

}  // namespace morepro::gap
