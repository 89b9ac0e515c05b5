#pragma once
#include "lib/gap/reference_point.hpp"

namespace morepro::host {

using gap::feed_speed_for;
using gap::reference_point_of;

/// The steady cut that a machine is made for; profiles are fractions of it.
struct OperatingPoint : gap::SteadyCut {
  double other_chip_load_mm = 0.0;  ///< after a change during the cut: another value of the bank's grid
};

OperatingPoint operating_point_of(const MachineParameters& machine);

}  // namespace morepro::host
