#pragma once
#include <cstdint>
#include <random>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/identify/machine_value.hpp"

namespace morepro::test {

/// The seven parameters alternately `factor` times too large and too small.
inline MonitorConfiguration wrong_by(const MonitorConfiguration& truth, double factor) {
  MonitorConfiguration wrong = truth;
  for (std::size_t j = 0; j < kParameterCount; ++j)
    host::value_in(wrong.machine, static_cast<host::MachineValue>(j)) *= j % 2 == 0 ? factor : 1.0 / factor;
  return wrong;
}

/// Each of the seven `factor` times too large or too small, at random.
inline MonitorConfiguration wrong_at_random(const MonitorConfiguration& truth, double factor,
                                            std::uint64_t seed) {
  MonitorConfiguration wrong = truth;
  std::mt19937_64 random(seed);
  for (std::size_t j = 0; j < kParameterCount; ++j)
    host::value_in(wrong.machine, static_cast<host::MachineValue>(j)) *=
        (random() & 1U) != 0 ? factor : 1.0 / factor;
  return wrong;
}

/// The seven parameters, in their order.
inline std::array<double, kParameterCount> values_of(const MachineParameters& machine) {
  std::array<double, kParameterCount> values{};
  for (std::size_t j = 0; j < kParameterCount; ++j)
    values[j] = host::value_in(machine, static_cast<host::MachineValue>(j));
  return values;
}

}  // namespace morepro::test
