#include "sim_host/machine/gap_key.hpp"

#include <array>

namespace morepro::host {
namespace {

constexpr std::array kKeys{
    GapKey{"speed_process_noise_rad_s", [](GapTuning& g) -> double& { return g.speed_process_noise_rad_s; }},
    GapKey{"current_process_noise_a", [](GapTuning& g) -> double& { return g.current_process_noise_a; }},
    GapKey{"feed_process_noise_m_s", [](GapTuning& g) -> double& { return g.feed_process_noise_m_s; }},
    GapKey{"spindle_evidence", [](GapTuning& g) -> double& { return g.spindle.evidence; }, 0.0, false},
    GapKey{"spindle_temperature", [](GapTuning& g) -> double& { return g.spindle.temperature; }, 1.0},
    GapKey{"spindle_excitation", [](GapTuning& g) -> double& { return g.spindle.excitation; }, 0.0, false},
    GapKey{"feed_evidence", [](GapTuning& g) -> double& { return g.feed.evidence; }, 0.0, false},
    GapKey{"feed_temperature", [](GapTuning& g) -> double& { return g.feed.temperature; }, 1.0},
    GapKey{"feed_excitation", [](GapTuning& g) -> double& { return g.feed.excitation; }, 0.0, false},
};

}  // namespace

std::span<const GapKey> gap_keys() { return kKeys; }

}  // namespace morepro::host
