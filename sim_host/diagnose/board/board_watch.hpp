#pragma once
#include <vector>

#include "lib/gap/gap_watch_finding.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// What of a recording a board is shown, and how it is to be judged.
struct BoardSight {
  Verdict verdict = Verdict::kNoGap;       ///< the host's
  std::vector<gap::Effect> causes{};       ///< that the host has found, and what looks like them
  gap::GapNoise<double> expected_noise{};  ///< of such a machine: what was fitted holds what has no name, too
  double since_s = 0.0;     ///< what it has seen before has faded: a cause that sets in then is there always
  bool is_excited = false;  ///< the recording tells causes apart; the least excitation that a name needs
                            ///< becomes half of what it has, where that is less
  bool is_spindle_quiet = false;  ///< nothing is wrong there but values: what the board would call an effect
  bool is_feed_quiet = false;     ///< is what noise makes of this machine, and is below its threshold then
};

/// The values that fit best without any effect, and beside those that were found.
struct FittedValues {
  MachineParameters without_effects;
  MachineParameters beside_effects;
  double spindle_spread = gap::kDatasheetSpread;  ///< of the latter ones, as a standard deviation; relative
  double feed_spread = gap::kDatasheetSpread;
};

/// What the board's own watch, in float, says about a recording of this machine with these settings. It looks
/// at 27 ms out of every 1.13 s (at 10 kHz), which is little of a short recording: so the statistics of
/// watches that begin a stretch as soon as they may are merged, as of a board that has seen the machine for
/// so long that it has seen all of this. It is given the values that fit best without any effect, those
/// beside the effects where these are so large that nothing explains them from there; where it finds nothing,
/// those of the machine file: what it finds then is that they are wrong. What noise of this machine has it
/// take for an effect is taken away from it in `settings`.
gap::GapFinding watch_on_board(const RecordingSignals& signals, const MachineDescription& machine,
                               const FittedValues& fitted, const BoardSight& sight,
                               gap::GapSettings& settings);

/// The same verdict; and where that names an effect, one side's first name is among the other side's aliases.
bool agree(const gap::GapFinding& board, const DiagnosisResult& host);

}  // namespace morepro::host
