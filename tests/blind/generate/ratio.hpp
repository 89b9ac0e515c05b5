#pragma once
#include <array>

#include "rows.hpp"
#include "simulate.hpp"

namespace blind {

using GroupPower = std::array<double, kGroups>;

/// Residual power per group after a refit of the nominal parameters, for the weights `floor`.
GroupPower refitted_power(const BalanceRows& rows, const GroupPower& floor);

/// The true noise floor of each balance: the same run without its effects.
struct Floor {
  std::array<GroupPower, kBalances> power;
};

Columns columns_of(const Run& run);
Floor floor_of(const Columns& without_effects, const Machine& nominal);

/// Mean whitened residual power of each balance after the refit: 1 is the floor.
std::array<double, kBalances> residual_ratios(const Columns& columns, const Machine& nominal,
                                              const Floor& floor);

/// Row power of the sensors' noise alone, from the datasheet.
GroupPower sensor_floor(const Machine& machine, Balance balance, double sample_s);

/// Standard deviations of the process noise that give `share` of the sensors' row power in each balance.
ProcessNoise process_noise_for(const Machine& machine, double share, double correlation_s,
                               double contact_gain, double sample_s);

}  // namespace blind
