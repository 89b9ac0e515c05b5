#pragma once
#include "lib/gap/effect_size.hpp"
#include "lib/plant/built_in_machines.hpp"

namespace morepro::test {

/// An effect of the reference machine.
inline gap::AppliedEffect effect(gap::Effect name, double size, double onset_s = 0.0) {
  const MachineParameters machine = reference_machine();
  gap::AppliedEffect one = gap::applied(name, size, {machine, gap::reference_point_of(machine)});
  one.onset_s = onset_s;
  return one;
}

}  // namespace morepro::test
