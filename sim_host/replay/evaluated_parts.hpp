#pragma once
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/replay/replay_result.hpp"

namespace morepro::host {

/// Which balances and estimates of a replay had what they need; the reason names the table of the machine
/// file or the columns of the recording that are missing.
std::vector<EvaluatedPart> evaluated_parts(const MachineDescription& machine, const ReplayResult& result);

}  // namespace morepro::host
