#pragma once
#include <span>
#include <string_view>

#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// One number of a table of a machine file that has a default.
template <typename Settings>
struct SettingKey {
  std::string_view key;
  double& (*of)(Settings& settings);
  double lowest = 0.0;
  bool may_be_lowest = true;
};
using GapKey = SettingKey<GapTuning>;
using WearKey = SettingKey<WearLimits>;

/// [gap]: what a diagnosis has found for the watch on the board. In the order of the file.
std::span<const GapKey> gap_keys();
/// [wear]: what the monitor calls a blunt tool. In the order of the file.
std::span<const WearKey> wear_keys();

}  // namespace morepro::host
