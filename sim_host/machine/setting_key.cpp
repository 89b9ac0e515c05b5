#include "sim_host/machine/setting_key.hpp"

#include <array>

namespace morepro::host {
namespace {

constexpr std::array kGapKeys{
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

constexpr std::array kWearKeys{
    WearKey{"watch_ratio", [](WearLimits& w) -> double& { return w.watch_ratio; }, 1.0},
    WearKey{"replace_ratio", [](WearLimits& w) -> double& { return w.replace_ratio; }, 1.0},
    WearKey{"low_ratio", [](WearLimits& w) -> double& { return w.low_ratio; }, 0.0, false},
    WearKey{"hold_s", [](WearLimits& w) -> double& { return w.hold_s; }},
    WearKey{"datasheet_tolerance", [](WearLimits& w) -> double& { return w.datasheet_tolerance; }},
};

}  // namespace

std::span<const GapKey> gap_keys() { return kGapKeys; }
std::span<const WearKey> wear_keys() { return kWearKeys; }

}  // namespace morepro::host
