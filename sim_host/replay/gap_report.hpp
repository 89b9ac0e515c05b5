#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/gap/gap_watch_finding.hpp"

namespace morepro::host {

/// The effect of a finding and its aliases; empty where it names none.
std::vector<gap::Effect> alias_set(const gap::GapFinding& finding);

/// What the watch on the board has found. Where it names no effect, there is null in its place.
nlohmann::ordered_json gap_json(const gap::GapFinding& finding);

/// The same on one line.
std::string gap_text(const gap::GapFinding& finding);

}  // namespace morepro::host
