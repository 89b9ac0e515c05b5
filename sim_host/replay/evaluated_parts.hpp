#pragma once
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/replay/replay_result.hpp"

namespace morepro::host {

/// Which balances and estimates of a replay had what they need; the reason names the table of the machine
/// file or the columns of the recording that are missing, or what the monitor has against the model.
std::vector<EvaluatedPart> evaluated_parts(const MachineDescription& machine, const ReplayResult& result);

/// Are the tables of the machine file and the columns of the recording there without which nothing can be
/// said about the tool?
bool can_judge_tool(const MachineDescription& machine, const ReplayResult& result);

}  // namespace morepro::host
