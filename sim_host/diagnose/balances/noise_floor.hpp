#pragma once
#include <array>
#include <vector>

#include "sim_host/diagnose/balances/window_rows.hpp"

namespace morepro::host {

/// What a model leaves of one window.
struct WindowResidual {
  std::size_t first = 0;  ///< interval at which the window begins
  bool in_contact = false;
  std::array<double, kRowsPerWindow> row{};
};

/// Of a band, without and with contact: the share that is noise of what a model leaves there.
using NoiseShares = std::array<std::array<double, 2>, kBands>;

/// What remembers itself from a window to the next that shares no sample with it is no noise, nor is what a
/// few windows hold: a model with effects may leave some of a gap, too. 1 where chance would do as much.
/// Windows in the order of time, half overlapping.
NoiseShares noise_shares(const std::vector<WindowResidual>& windows);

}  // namespace morepro::host
