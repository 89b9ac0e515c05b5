#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/recording/recording_reader.hpp"

namespace morepro::host {

/// Reads a whole recording; `usable`: bit_of(channel) of what the machine can do something with. Values that
/// no sensor of that kind can give become missing samples. Throws UserError where a row cannot be read.
RecordingSignals load_signals(RecordingReader& recording, std::uint16_t usable);

/// Says of which channels such values were, and of how many samples.
std::vector<std::string> impossible_samples(const RecordingSignals& signals);

/// Without a contact law a spindle in contact has a torque that nobody described: throws UserError.
void check_contact(const RecordingSignals& signals, const MachineDescription& machine);

}  // namespace morepro::host
