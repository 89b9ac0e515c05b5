#include "sim_host/identify/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_host/identify/axis_identification.hpp"
#include "sim_host/identify/derivative_pass.hpp"
#include "sim_host/identify/parameter_verdict.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

constexpr double kColoured = 0.5;  // correlation of innovations of a model that does not fit

/// Of a mean over samples that are correlated with their neighbours; and sensors that are noisier than described.
double inflation_of(double ratio, double correlation) {
  const double coloured = std::clamp(correlation, 0.0, 0.99);
  return std::sqrt(std::max(ratio, 1.0) * (1.0 + coloured) / (1.0 - coloured));
}

class Identifier {
 public:
  Identifier(const RecordingSignals& signals, const MachineDescription& machine, IdentificationFilter filter,
             const OnStage& on_stage)
      : signals_(signals), machine_(machine), on_stage_(on_stage) {
    result_.filter = filter;
    result_.machine = machine.name;
    result_.rows = signals.rows;
    result_.rate_hz = signals.rate_hz;
    result_.duration_s = signals.duration_s();
    result_.missing_rows = signals.missing_rows;
    for (std::size_t j = 0; j < kParameterCount; ++j) obstruct(static_cast<Parameter>(j));
  }

  IdentificationResult run() {
    if (result_.filter == IdentificationFilter::kDerivatives) {
      if (is_open_any(std::array{Parameter::kTorqueConstant, Parameter::kMass}))
        for (const AxisEstimate& estimate : derivative_estimates()) take(estimate);
    } else {
      if (is_open_any(SpindleTraits::kParameters)) take_axis<SpindleTraits>("spindle");
      if (is_open_any(FeedTraits::kParameters)) take_axis<FeedTraits>("feed");
    }
    advise();
    return std::move(result_);
  }

 private:
  void obstruct(Parameter parameter) {
    std::string obstacle = obstacle_to(parameter, result_.filter, signals_, machine_);
    is_open_[index_of(parameter)] = obstacle.empty();
    result_.parameters.push_back(unanswered(parameter, machine_, std::move(obstacle)));
  }

  template <std::size_t kCount>
  bool is_open_any(const std::array<Parameter, kCount>& parameters) const {
    return std::any_of(parameters.begin(), parameters.end(), [&](Parameter p) { return is_open_[index_of(p)]; });
  }

  std::vector<AxisEstimate> derivative_estimates() const {
    on_stage_("accelerations");
    return derivative_pass(signals_, machine_.configuration);
  }

  template <class Traits>
  void take_axis(const char* axis) {
    const auto found = identify_axis<Traits>(signals_, machine_.configuration, [&] { on_stage_(axis); });
    result_.axes.push_back(
        {axis, found.last.ratio, found.last.correlation, found.process_share, found.passes});
    take({.parameters = {Traits::kParameters.begin(), Traits::kParameters.end()},
          .value = {found.last.value.begin(), found.last.value.end()},
          .covariance = found.last.covariance,
          .inflation = inflation_of(found.last.ratio, found.last.correlation),
          .has_settled = found.has_settled,
          .fits = found.last.correlation < kColoured});
  }

  void take(const AxisEstimate& estimate) {
    for (std::size_t i = 0; i < estimate.parameters.size(); ++i) {
      const std::size_t j = index_of(estimate.parameters[i]);
      if (is_open_[j]) result_.parameters[j] = answered(estimate, i, machine_);
    }
  }

  void advise() {
    std::vector<std::string> wanted;
    bool is_any_open = false;
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      if (!is_open_[j]) continue;
      is_any_open = true;
      const std::string advice = excitation_for(static_cast<Parameter>(j));
      if (!result_.parameters[j].is_identifiable && std::find(wanted.begin(), wanted.end(), advice) == wanted.end())
        wanted.push_back(advice);
    }
    result_.is_sufficient = is_any_open && wanted.empty();
    if (!is_any_open)
      result_.advice = "record the inputs and what moves: 'identify --help' lists the columns";
    else if (!wanted.empty())
      result_.advice = fmt::format("record {}", fmt::join(wanted, "; "));
  }

  const RecordingSignals& signals_;
  const MachineDescription& machine_;
  const OnStage& on_stage_;
  std::array<bool, kParameterCount> is_open_{};
  IdentificationResult result_;
};

void set_value(MachineParameters& machine, Parameter parameter, double value) {
  switch (parameter) {
    case Parameter::kTorqueConstant:
      machine.spindle.torque_constant_nm_a = value;
      break;
    case Parameter::kInertia:
      machine.spindle.inertia_kgm2 = value;
      break;
    case Parameter::kMass:
      machine.feed.mass_kg = value;
      break;
    case Parameter::kContactForce:
      machine.feed.contact_force_n = value;
      break;
    case Parameter::kInductance:
      machine.spindle.inductance_h = value;
      break;
    case Parameter::kResistance:
      machine.spindle.resistance_ohm = value;
      break;
    case Parameter::kBackEmfConstant:
      machine.spindle.back_emf_constant_vs_rad = value;
      break;
  }
}

}  // namespace

IdentificationResult identify(const RecordingSignals& signals, const MachineDescription& machine,
                              IdentificationFilter filter, const OnStage& on_stage) {
  return Identifier(signals, machine, filter, on_stage).run();
}

MachineDescription identified_machine(const MachineDescription& machine, const IdentificationResult& result) {
  MachineDescription identified = machine;
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    const ParameterResult& parameter = result.parameters[j];
    if (parameter.is_identifiable)
      set_value(identified.configuration.machine, static_cast<Parameter>(j), parameter.refit);
  }
  return identified;
}

}  // namespace morepro::host
