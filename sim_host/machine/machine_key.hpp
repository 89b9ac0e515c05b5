#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// One number of a machine file: where it stands, which parameter it is, which values are possible.
struct MachineKey {
  enum class Needed : std::uint8_t { kAlways, kByConsistentForm, kByThesisForm, kNever };
  enum class Range : std::uint8_t { kPositive, kNotNegative, kAnyFinite };

  std::string_view table;
  std::string_view key;
  double& (*of)(MachineParameters& machine);
  Needed needed = Needed::kAlways;  ///< in a file that has the table
  Range range = Range::kPositive;
  double neutral = 0.0;  ///< the value where the key is absent: the effect is not there
};

/// Every number of the tables [spindle], [feed], [tool], [contact] and [thermal], in the order of the file.
std::span<const MachineKey> machine_keys();

/// "spindle.resistance_ohm"
std::string full_name(const MachineKey& key);

/// Sets every parameter of a table to its neutral value.
void set_neutral(std::string_view table, MachineParameters& machine);

}  // namespace morepro::host
