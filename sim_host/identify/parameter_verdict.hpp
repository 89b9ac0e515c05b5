#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim_host/diagnose/diagnosis_result.hpp"
#include "sim_host/diagnose/recording_signals.hpp"
#include "sim_host/identify/identification.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// What a filter found of the parameters of one balance or axis.
struct AxisEstimate {
  std::vector<Parameter> parameters;
  std::vector<double> value;
  Eigen::MatrixXd covariance;  ///< of the logarithms of the values
  double inflation = 1.0;      ///< what its standard errors are to be multiplied by, >= 1
  bool has_settled = true;
  bool fits = true;
};

/// Why the filter cannot say anything on a parameter: what is not recorded or not described; empty: it can.
std::string obstacle_to(Parameter parameter, IdentificationFilter filter, const RecordingSignals& signals,
                        const MachineDescription& machine);

/// A parameter without an answer.
ParameterResult unanswered(Parameter parameter, const MachineDescription& machine, std::string reason);

/// The answer on parameter number `index` of an estimate, with what would make it identifiable.
ParameterResult answered(const AxisEstimate& estimate, std::size_t index, const MachineDescription& machine);

/// What a recording must hold so that a parameter can be told.
const char* excitation_for(Parameter parameter);

}  // namespace morepro::host
