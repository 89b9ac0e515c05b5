#pragma once
#include "lib/gap/gap_watch_finding.hpp"
#include "sim_host/diagnose/diagnosis_result.hpp"
#include "sim_host/diagnose/recording_signals.hpp"

namespace morepro::host {

/// What the board's own watch, in float, says about a recording of this machine with these settings. It looks
/// at 27 ms out of every 1.13 s (at 10 kHz), which is little of a short recording: so the statistics of
/// watches that begin a stretch as soon as they may are merged, as of a board that has seen the machine for
/// so long that it has seen all of this. Where it says that values of the datasheet are wrong, it is given
/// the `refitted` ones and looks again: an effect that it then finds is its answer. `is_excited`: the
/// recording tells causes apart; the least excitation that a name needs becomes half of what it has, where
/// that is less.
gap::GapFinding watch_on_board(const RecordingSignals& signals, const MachineParameters& datasheet,
                               const MachineParameters& refitted, bool is_excited,
                               gap::GapSettings& settings);

/// The same verdict; and where that names an effect, one side's first name is among the other side's aliases.
bool agree(const gap::GapFinding& board, const DiagnosisResult& host);

}  // namespace morepro::host
