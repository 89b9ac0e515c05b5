#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// Which equations the parameters are found with.
enum class IdentificationFilter : std::uint8_t {
  kStates,       ///< measured speeds and current, the default
  kDerivatives,  ///< derivatives of speeds and current, the thesis's own form
};

/// How well the model of one axis fits with the parameters that were found.
struct AxisFitFigures {
  std::string axis;
  double innovation_ratio = 1.0;  ///< mean squared innovation in the sensors' noise; 1: as the sensors say
  double correlation = 0.0;       ///< of neighbouring innovations; 0: nothing is left to explain
  std::array<double, 2> process_share{};  ///< process noise per sample, of the variance of each sensor
  int passes = 0;
};

/// Where the derivative of a balance comes from.
struct DerivativeOrigin {
  std::string quantity;
  bool is_measured = false;  ///< else: a difference over one sampling period
};

struct IdentificationResult {
  std::string file;
  std::string machine;
  std::size_t rows = 0;
  double rate_hz = 0.0;
  double duration_s = 0.0;
  std::size_t missing_rows = 0;
  IdentificationFilter filter = IdentificationFilter::kStates;
  /// In the order of MachineValue, the frictions only where they were found; NaN: no value.
  std::vector<ParameterResult> parameters;
  std::vector<AxisFitFigures> axes;
  std::vector<DerivativeOrigin> derivatives;  ///< empty with kStates
  bool is_sufficient = false;  ///< everything was identified that the recorded signals could tell
  std::string advice;          ///< what to record so that more is; empty where nothing is missing
};

/// Called with the name of the stage before every pass over the recording.
using OnStage = std::function<void(const std::string& stage)>;

/// Identifies the seven parameters of a machine, the machine's values being the datasheet's. Where the
/// recording tells the viscous friction of an axis too, it is found with them; else the datasheet's is taken,
/// and said.
IdentificationResult identify(const RecordingSignals& signals, const MachineDescription& machine,
                              IdentificationFilter filter, const OnStage& on_stage);

/// The machine with the values that were identified; the others stay the datasheet's.
MachineDescription identified_machine(const MachineDescription& machine, const IdentificationResult& result);

std::string identification_json(const IdentificationResult& result);
std::string identification_text(const IdentificationResult& result);

}  // namespace morepro::host
