#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/identify/axis_identification.hpp"
#include "sim_host/identify/identification.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Why the filter cannot say anything on a parameter: what is not recorded or not described; empty: it can.
std::string obstacle_to(MachineValue value, IdentificationFilter filter, const RecordingSignals& signals,
                        const MachineDescription& machine);

/// A parameter without an answer.
ParameterResult unanswered(MachineValue value, const MachineDescription& machine, std::string reason);

/// The answer on parameter number `index` of an estimate, with what would make it identifiable.
ParameterResult answered(const AxisEstimate& estimate, std::size_t index, const MachineDescription& machine);

/// Is number `index` known well enough to be used?
bool is_told(const AxisEstimate& estimate, std::size_t index);

}  // namespace morepro::host
