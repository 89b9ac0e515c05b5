#pragma once
#include <functional>

#include "sim_host/machine/machine_description.hpp"
#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/replay/replay_result.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Where the answers of a replay go, apart from the result; null: nowhere.
struct ReplayOutputs {
  OutputFile* answers = nullptr;  ///< the board's messages, byte by byte
  /// After every frame: the frame as the board gave it, the monitor after it.
  std::function<void(const SensorFrame& frame, const BoardMonitor& monitor)> on_frame;
};

/// Feeds a recording through the simulated board into the loop and the monitor of the board images.
/// Throws UserError for a malformed recording, and for a configuration that the monitor refuses.
ReplayResult replay(RecordingReader& recording, const MachineDescription& machine,
                    const ReplayOutputs& outputs);

/// The machine that a recording is judged with: the one asked for (`name_or_path`, may be empty), else the
/// one in the recording, else the built-in one that its metadata name, else the reference machine. Its rate
/// is the recording's. Adds a sentence to `notices` for everything that was assumed.
MachineDescription machine_for(const RecordingReader& recording, const std::string& name_or_path,
                               std::vector<std::string>& notices);

}  // namespace morepro::host
