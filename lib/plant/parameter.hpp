#pragma once
#include <cstddef>
#include <cstdint>

namespace morepro {

/// The parameters that can be identified. The order of Health::parameters and of the columns of
/// Plant::parameter_jacobian.
enum class Parameter : std::uint8_t {
  kTorqueConstant = 0,
  kInertia,
  kMass,
  kContactForce,
  kInductance,
  kResistance,
  kBackEmfConstant,
};
inline constexpr std::size_t kParameterCount = 7;

constexpr std::size_t index_of(Parameter parameter) { return static_cast<std::size_t>(parameter); }

}  // namespace morepro
