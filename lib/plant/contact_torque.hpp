#pragma once
#include <cstdint>

namespace morepro {

/// Where a contact law left the range that it was fitted in; bits of ContactTorque::flags. The value was
/// clamped.
enum class ContactFlag : std::uint8_t {
  kCuttingSpeedLow = 1,
  kCuttingSpeedHigh = 2,
  kFeedLow = 4,
  kFeedHigh = 8,
};

constexpr std::uint8_t bits_of(ContactFlag flag) { return static_cast<std::uint8_t>(flag); }

/// Range of equation 12: cutting speed in m/min, feed in mm per revolution.
struct ContactRange {
  static constexpr double kLowestCuttingSpeed = 70.0;
  static constexpr double kHighestCuttingSpeed = 230.0;
  static constexpr double kLowestFeed = 0.08;
  static constexpr double kHighestFeed = 0.47;
};

/// One summand or factor of the law with its slopes; a slope is 0 where a clamp holds the value.
template <class Real>
struct ContactTerm {
  Real value = 0;
  Real per_speed = 0;      ///< per rad/s
  Real per_chip_load = 0;  ///< per mm
  std::uint8_t flags = 0;  ///< ContactFlag bits
};

/// Torque of the cut on the spindle, and its slopes.
template <class Real>
struct ContactTorque {
  Real torque_nm = 0;
  Real per_speed = 0;      ///< d torque / d speed, N m s/rad
  Real per_chip_load = 0;  ///< d torque / d chip load, N m/mm
  Real beta = 0;           ///< friction coefficient, dimensionless, >= 0
  std::uint8_t flags = 0;  ///< ContactFlag bits
};

}  // namespace morepro
