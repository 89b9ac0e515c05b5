#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "lib/gap/effect.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// With fewer nothing is judged.
inline constexpr std::size_t kFewestRows = 1000;
/// That these are fewer; empty: they are not.
std::string too_short(const RecordingSignals& signals);

/// Why there is no verdict, where nothing was judged or, of what is evaluated, nothing was excited.
std::string why_undetermined(const RecordingSignals& signals, bool is_any_evaluated);

/// What a balance needs and the machine file or the recording does not have; empty: nothing is missing.
std::string why_not_evaluated(gap::Balance balance, const RecordingSignals& signals,
                              const MachineDescription& machine);

/// Can an axis be diagnosed at all? The spindle's voltage alone cannot.
bool is_evaluable(Axis axis, const RecordingSignals& signals, const MachineDescription& machine);

/// Adds the balances that `where` does not have, each with the reason.
void add_unevaluated(const RecordingSignals& signals, const MachineDescription& machine,
                     std::vector<BalanceResult>& where);

/// What cannot be looked for, or told from a gap, although its balance is evaluated, and why: a sentence
/// each.
std::vector<std::string> untested_effects(const RecordingSignals& signals, const MachineDescription& machine);

}  // namespace morepro::host
