#pragma once
#include <vector>

#include "lib/gap/gap_frame.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// What a board's watch is shown of a row.
struct BoardFrame {
  gap::GapFrame<float> frame;
  bool is_missing = false;
  bool is_lost = false;  ///< missing, or all of its samples are
};

/// Of every row of the grid. What a recording does not hold, the machine file does; no value of that is
/// fitted. The effects that it states are taken out by the monitor, as on a board, with the values of
/// `refitted`.
std::vector<BoardFrame> board_frames(const RecordingSignals& signals, const MachineDescription& machine,
                                     const MachineParameters& refitted);

}  // namespace morepro::host
