#pragma once
#include "lib/gap/effect_signals.hpp"
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

/// Where effects are normalised: the steady cut, with the winding at the temperature of its datasheet. A
/// machine without a cut that 1000 V reach gets its speed at 24 V without load, and a tenth of its current at
/// 24 V and standstill. Speeds, current and chip load are > 0.
gap::ReferencePoint reference_point_of(const MachineParameters& machine);

/// Feed speed in m/s at which every tooth takes `chip_load_mm`.
double feed_speed_for(const MachineParameters& machine, double speed_rad_s, double chip_load_mm);

}  // namespace morepro::host
