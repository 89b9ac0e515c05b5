#pragma once
#include <string>

#include "sim_host/replay/replay_result.hpp"

namespace morepro::host {

/// The result for a person. `with_colour`: the verdict in the terminal's colours.
std::string result_text(const ReplayResult& result, bool with_colour);

}  // namespace morepro::host
