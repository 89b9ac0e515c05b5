#pragma once
#include <span>
#include <string_view>

#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// One number of the table [gap] of a machine file: what a diagnosis has found for the watch on the board.
struct GapKey {
  std::string_view key;
  double& (*of)(GapTuning& gap);
  double lowest = 0.0;
  bool may_be_lowest = true;
};

/// In the order of the file.
std::span<const GapKey> gap_keys();

}  // namespace morepro::host
