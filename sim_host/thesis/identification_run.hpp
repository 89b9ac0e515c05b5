#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/identification/derivative_identification.hpp"
#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host::thesis {

using ParameterValues = std::array<double, kParameterCount>;  ///< in the order of Parameter

/// The seven parameters of a machine.
ParameterValues parameters_of(const MachineParameters& machine);

/// What the machine is driven with.
enum class Drive {
  kConstant,  ///< as in the thesis: in contact, from the steady state on, nothing changes
  kExcited,   ///< two-level noise on voltage and feed force, contact on and off
};

struct IdentificationSetting {
  Drive drive = Drive::kConstant;
  ParameterValues start{};  ///< what the filter begins with
  double duration_s = 4.0;
  std::uint64_t seed = 1;
};

/// Estimates over time, every 10 ms, and what is known in the end.
struct IdentificationTrace {
  std::vector<double> time_s;
  std::array<std::vector<double>, kParameterCount> value;
  std::array<ParameterEstimate, kParameterCount> last{};  ///< of run_library_filter only
  /// What the last window of run_guarded_filter told of each parameter, and with which other one.
  std::array<Information, kParameterCount> information{};
  std::array<Parameter, kParameterCount> partner{};

  [[nodiscard]] double end(Parameter parameter) const { return value[index_of(parameter)].back(); }
};

/// The filter of the thesis, with its measured derivatives.
IdentificationTrace run_printed_filter(const IdentificationSetting& setting);
/// The same filter as lib/identification has it: float32, UD-factored in blocks, with its guards.
IdentificationTrace run_guarded_filter(const IdentificationSetting& setting);
/// The filters of lib/identification, as on the board: speeds and current are measured.
IdentificationTrace run_library_filter(const IdentificationSetting& setting);

/// Steady state of the thesis's machine under the constant drive: speed in rad/s, current in A.
struct SteadyState {
  double voltage_v = 0.0;
  double speed_rad_s = 0.0;
  double current_a = 0.0;
};
SteadyState steady_state();

}  // namespace morepro::host::thesis
