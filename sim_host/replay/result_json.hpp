#pragma once
#include <string>

#include "sim_host/replay/replay_result.hpp"

namespace morepro::host {

/// The result as JSON, schema "morepro.replay/1". What is undetermined is null, never a number.
std::string result_json(const ReplayResult& result);

}  // namespace morepro::host
