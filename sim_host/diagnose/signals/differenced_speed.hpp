#pragma once
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Speeds that were shown as differences of a rounded position, as counters do. Two roundings are in each
/// sample, twice the variance of a rounded speed: `sensors` get the second one as noise.
std::vector<Channel> allow_for_differences(const RecordingSignals& signals, Sensors& sensors);

}  // namespace morepro::host
