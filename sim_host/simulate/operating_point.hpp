#pragma once
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// The steady cut that a machine is made for; profiles are fractions of it.
struct OperatingPoint {
  double speed_rad_s = 0.0;
  double voltage_v = 0.0;       ///< holds the speed in contact, at the nominal chip load
  double feed_speed_m_s = 0.0;  ///< gives the nominal chip load at that speed
  double chip_load_mm = 0.0;
  double other_chip_load_mm = 0.0;  ///< after a change during the cut: another value of the bank's grid
};

OperatingPoint operating_point_of(const MachineParameters& machine);

/// Feed speed in m/s at which every tooth takes `chip_load_mm`.
double feed_speed_for(const MachineParameters& machine, double speed_rad_s, double chip_load_mm);

}  // namespace morepro::host
