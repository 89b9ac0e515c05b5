#pragma once
#include <array>
#include <cstddef>

#include "lib/identification/derivative_rows.hpp"
#include "lib/plant/machine_parameters.hpp"
#include "sim_host/identify/machine_value.hpp"

namespace morepro::host {

/// One balance of equation 22 with the viscous friction of its axis as one more parameter, the last: its row
/// with slopes by the logarithms of the parameters.
struct TorqueBalance {
  static constexpr std::array kValues{MachineValue::kTorqueConstant, MachineValue::kInertia,
                                      MachineValue::kSpindleFriction};
  using Values = std::array<double, kValues.size()>;

  static DerivativeRow<double, 3> row(const Values& v, const MachineParameters& /*machine*/,
                                      const DerivativeInput<double>& u) {
    const auto [derivative, slope] = torque_row<double>({v[0], v[1]}, v[2], u);
    return {derivative, {slope[0] * v[0], slope[1] * v[1], -v[2] * u.speed_rad_s / v[1]}};
  }
};

struct ForceBalance {
  static constexpr std::array kValues{MachineValue::kMass, MachineValue::kContactForce,
                                      MachineValue::kFeedFriction};
  using Values = std::array<double, kValues.size()>;

  static DerivativeRow<double, 3> row(const Values& v, const MachineParameters& machine,
                                      const DerivativeInput<double>& u) {
    const auto [derivative, slope] = force_row<double>({v[0], v[1]}, v[2], machine.feed.contact_offset_n, u);
    return {derivative, {slope[0] * v[0], slope[1] * v[1], -v[2] * u.feed_speed_m_s / v[0]}};
  }
};

struct VoltageBalance {
  static constexpr std::array kValues{MachineValue::kInductance, MachineValue::kResistance,
                                      MachineValue::kBackEmfConstant};
  using Values = std::array<double, kValues.size()>;

  static DerivativeRow<double, 3> row(const Values& v, const MachineParameters& /*machine*/,
                                      const DerivativeInput<double>& u) {
    const auto [derivative, slope] = voltage_row<double>(v, u);
    return {derivative, {slope[0] * v[0], slope[1] * v[1], slope[2] * v[2]}};
  }
};

}  // namespace morepro::host
