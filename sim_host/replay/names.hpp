#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "lib/frame/frame_flag.hpp"
#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// "NOT_ENOUGH_DATA", as in JSON.
std::string_view name_of(HealthState state);
/// "markov", as on the command line.
std::string_view name_of(DecisionRule rule);
/// "valid" or "undetermined".
std::string_view name_of(ChipLoadState state);
/// Key of the machine file, for example "inertia_kgm2".
std::string_view name_of(Parameter parameter);
/// The same, of what a parameter is told with only.
std::string_view name_of(Partner partner);
/// "duplicate", as in JSON.
std::string_view name_of(FrameFlag flag);
/// One clause: why a parameter may not be used; empty where it may.
std::string reason_of(const ParameterEstimate& estimate);

/// The datasheet's value.
double datasheet_value(const MachineParameters& machine, Parameter parameter);

/// All flags, in the order of their bits.
inline constexpr std::uint16_t kFrameFlagCount = 14;

}  // namespace morepro::host
