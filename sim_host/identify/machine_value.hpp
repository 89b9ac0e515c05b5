#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lib/plant/machine_parameters.hpp"
#include "lib/plant/parameter.hpp"

namespace morepro::host {

/// The values of a machine that a recording may tell: the seven of Parameter, in its order, and the viscous
/// friction of each axis.
enum class MachineValue : std::uint8_t {
  kTorqueConstant = 0,
  kInertia,
  kMass,
  kContactForce,
  kInductance,
  kResistance,
  kBackEmfConstant,
  kSpindleFriction,
  kFeedFriction,
};
inline constexpr std::size_t kMachineValueCount = 9;

constexpr std::size_t index_of(MachineValue value) { return static_cast<std::size_t>(value); }

constexpr MachineValue value_of(Parameter parameter) { return static_cast<MachineValue>(parameter); }
// One order for both: the first and the last of the seven stand where Parameter has them.
static_assert(value_of(Parameter::kTorqueConstant) == MachineValue::kTorqueConstant &&
              value_of(Parameter::kBackEmfConstant) == MachineValue::kBackEmfConstant &&
              index_of(MachineValue::kSpindleFriction) == kParameterCount);

constexpr bool is_of_feed(MachineValue value) {
  return value == MachineValue::kMass || value == MachineValue::kContactForce ||
         value == MachineValue::kFeedFriction;
}
constexpr bool is_friction(MachineValue value) { return value >= MachineValue::kSpindleFriction; }

/// Its key in a machine file.
std::string_view name_of(MachineValue value);

/// What a recording must hold so that it can be told.
const char* excitation_for(MachineValue value);

/// What an identified contact force rests on: no constant engagement tells the two apart.
inline constexpr const char* kWithContactOffset =
    "only together with contact_offset_n, which is taken for the datasheet's; to tell them apart, record "
    "different engagements";

/// Where a machine keeps it.
double& value_in(MachineParameters& machine, MachineValue value);
double value_in(const MachineParameters& machine, MachineValue value);

}  // namespace morepro::host
