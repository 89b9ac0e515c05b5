#include "sim_host/identify/identification.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim_host/identify/axis_identification.hpp"
#include "sim_host/identify/balance_fit.hpp"
#include "sim_host/identify/derivative_source.hpp"
#include "sim_host/identify/parameter_verdict.hpp"

namespace morepro::host {
namespace {

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
    for (std::size_t j = 0; j < kMachineValueCount; ++j) obstruct(static_cast<MachineValue>(j));
  }

  IdentificationResult run() {
    if (result_.filter == IdentificationFilter::kDerivatives) {
      take_balances();
    } else {
      if (is_open(MachineValue::kTorqueConstant)) take_axis<SpindleTraits>("spindle");
      if (is_open(MachineValue::kMass)) take_axis<FeedTraits>("feed");
    }
    advise();
    // A friction that was not asked for has no line of its own.
    std::erase_if(result_.parameters, [&](const ParameterResult& p) { return p.reason == kNotAsked; });
    return std::move(result_);
  }

 private:
  static constexpr const char* kNotAsked = "not asked for";

  bool is_open(MachineValue value) const { return is_open_[index_of(value)]; }

  void obstruct(MachineValue value) {
    std::string obstacle =
        is_friction(value) ? std::string(kNotAsked) : obstacle_to(value, result_.filter, signals_, machine_);
    is_open_[index_of(value)] = obstacle.empty();
    result_.parameters.push_back(unanswered(value, machine_, std::move(obstacle)));
  }

  /// With the friction where the recording tells it.
  template <class Traits>
  void take_axis(const char* axis) {
    const AxisEstimate found =
        identify_axis<Traits>(signals_, machine_.configuration, [&] { on_stage_(axis); });
    const std::size_t last = found.names.size() - 1;
    is_open_[index_of(Traits::kValues.back())] = is_friction(found.names[last]) && is_told(found, last);
    result_.axes.push_back({axis, found.ratio, found.correlation, found.process_share, found.passes});
    take(found);
  }

  /// The means over a period of one balance of the spindle need the other's parameters, so both come twice.
  void take_balances() {
    MonitorConfiguration found = machine_.configuration;
    const bool has_torque = is_open(MachineValue::kTorqueConstant);
    const bool has_voltage = is_open(MachineValue::kInductance);
    for (int round = 0; round < 2; ++round) {
      if (has_torque) take_balance<TorqueBalance>("spindle_speed", DerivativeBalance::kTorque, found);
      if (has_voltage) take_balance<VoltageBalance>("armature_current", DerivativeBalance::kVoltage, found);
    }
    if (is_open(MachineValue::kMass))
      take_balance<ForceBalance>("feed_speed", DerivativeBalance::kForce, found);
  }

  /// `found`: where its parameters start, and what they became.
  template <class Balance>
  void take_balance(const char* quantity, DerivativeBalance balance, MonitorConfiguration& found) {
    const OnPass on_pass = [&] { on_stage_(quantity); };
    const AxisEstimate estimate = fit_balance<Balance>(balance, signals_, found, on_pass);
    for (std::size_t i = 0; i < estimate.names.size(); ++i) {
      const MachineValue name = estimate.names[i];
      const bool has_value = is_told(estimate, i) && value_in(machine_.configuration.machine, name) > 0.0;
      if (has_value) value_in(found.machine, name) = estimate.value[i];
      if (is_friction(name)) is_open_[index_of(name)] = has_value;
    }
    take(estimate);
    const bool is_new = std::none_of(result_.derivatives.begin(), result_.derivatives.end(),
                                     [&](const auto& origin) { return origin.quantity == quantity; });
    if (is_new) result_.derivatives.push_back({quantity, is_measured(balance, signals_)});
  }

  void take(const AxisEstimate& estimate) {
    for (std::size_t i = 0; i < estimate.names.size(); ++i) {
      const std::size_t j = index_of(estimate.names[i]);
      if (is_open_[j]) result_.parameters[j] = answered(estimate, i, machine_);
    }
  }

  void advise() {
    std::vector<std::string> wanted;
    bool is_any_open = false;
    for (std::size_t j = 0; j < kMachineValueCount; ++j) {
      if (!is_open_[j]) continue;
      is_any_open = true;
      const std::string advice = excitation_for(static_cast<MachineValue>(j));
      if (!result_.parameters[j].is_identifiable &&
          std::find(wanted.begin(), wanted.end(), advice) == wanted.end())
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
  std::array<bool, kMachineValueCount> is_open_{};
  IdentificationResult result_;
};

}  // namespace

IdentificationResult identify(const RecordingSignals& signals, const MachineDescription& machine,
                              IdentificationFilter filter, const OnStage& on_stage) {
  return Identifier(signals, machine, filter, on_stage).run();
}

MachineDescription identified_machine(const MachineDescription& machine, const IdentificationResult& result) {
  MachineDescription identified = machine;
  for (std::size_t j = 0; j < kMachineValueCount; ++j) {
    const auto value = static_cast<MachineValue>(j);
    for (const ParameterResult& p : result.parameters)
      if (p.is_identifiable && p.name == name_of(value))
        value_in(identified.configuration.machine, value) = p.refit;
  }
  return identified;
}

}  // namespace morepro::host
