#include "sim_host/diagnose/result/unevaluated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/search/winding_heat.hpp"

namespace morepro::host {
namespace {

constexpr const char* kVoltageNotRecorded = "not recorded: armature_voltage_v";

/// The columns that are not recorded, one after the other.
class Missing {
 public:
  explicit Missing(const RecordingSignals& signals) : signals_(signals) {}

  Missing& need(Channel channel) {
    if (!signals_.has(channel)) add(kChannels[index_of(channel)].column);
    return *this;
  }

  Missing& need_one_of(Channel a, Channel b) {
    if (!signals_.has(a) && !signals_.has(b))
      add(fmt::format("{} or {}", kChannels[index_of(a)].column, kChannels[index_of(b)].column));
    return *this;
  }

  [[nodiscard]] std::string text() const { return names_.empty() ? "" : "not recorded: " + names_; }

 private:
  void add(std::string_view name) {
    if (!names_.empty()) names_ += ", ";
    names_ += name;
  }

  const RecordingSignals& signals_;
  std::string names_;
};

}  // namespace

std::string too_short(const RecordingSignals& signals) {
  if (signals.rows >= kFewestRows) return "";
  return fmt::format("the recording is shorter than {} rows", kFewestRows);
}

std::string why_undetermined(const RecordingSignals& signals, bool is_any_evaluated) {
  if (std::string lack = too_short(signals); !lack.empty()) return lack;
  if (!is_any_evaluated)
    return "no balance has its signals in the recording and its values in the machine file";
  return "nothing moves enough in the recording to tell what a model leaves out";
}

std::string why_not_evaluated(gap::Balance balance, const RecordingSignals& signals,
                              const MachineDescription& machine) {
  Missing missing(signals);
  if (balance == gap::Balance::kFeedForce) {
    if (!machine.has_feed) return "the machine file has no [feed]";
    return missing.need(Channel::kFeedForce).need_one_of(Channel::kFeedSpeed, Channel::kFeedPosition).text();
  }
  if (!machine.has_spindle) return "the machine file has no [spindle]";
  if (balance == gap::Balance::kArmatureVoltage && signals.is_current_driven) return kVoltageNotRecorded;
  missing.need(Channel::kArmatureVoltage).need(Channel::kSpindleSpeed);
  if (balance == gap::Balance::kArmatureVoltage) missing.need(Channel::kArmatureCurrent);
  return missing.text();
}

bool is_evaluable(Axis axis, const RecordingSignals& signals, const MachineDescription& machine) {
  const auto balance = axis == Axis::kSpindle ? gap::Balance::kSpindleTorque : gap::Balance::kFeedForce;
  return why_not_evaluated(balance, signals, machine).empty();
}

void add_unevaluated(const RecordingSignals& signals, const MachineDescription& machine,
                     std::vector<BalanceResult>& where) {
  for (std::size_t b = 0; b < gap::kBalanceCount; ++b) {
    BalanceResult absent{.balance = static_cast<gap::Balance>(b)};
    if (std::any_of(where.begin(), where.end(),
                    [&](const BalanceResult& known) { return known.balance == absent.balance; }))
      continue;
    absent.reason = why_not_evaluated(absent.balance, signals, machine);
    if (absent.reason.empty()) absent.reason = too_short(signals);
    if (absent.reason.empty()) absent.reason = "nothing tells it";
    where.push_back(std::move(absent));
  }
}

std::vector<std::string> untested_effects(const RecordingSignals& signals,
                                          const MachineDescription& machine) {
  const auto is_evaluated = [&](gap::Balance balance) {
    return why_not_evaluated(balance, signals, machine).empty();
  };
  const auto column = [](Channel channel) { return kChannels[index_of(channel)].column; };
  std::vector<std::string> untested;
  if (machine.has_contact && !signals.has(Channel::kContact) &&
      (is_evaluated(gap::Balance::kSpindleTorque) || is_evaluated(gap::Balance::kFeedForce)))
    untested.push_back(fmt::format(
        "{} is not recorded: the tool is taken to be in the air, and a cut would pass for a gap or for noise",
        column(Channel::kContact)));
  const bool shows_cut = signals.has_been_in_contact() && is_evaluated(gap::Balance::kSpindleTorque);
  if (shows_cut && !signals.has(Channel::kChipLoad))
    untested.push_back(fmt::format(
        "{} is not recorded: the machine file's is taken, another one would pass for a gap, and {} is not "
        "looked for",
        column(Channel::kChipLoad), gap::name_of(gap::Effect::kContactChipLoadDependence)));
  if (shows_cut && !signals.has(Channel::kToolTemperature))
    untested.push_back(fmt::format("{} is not recorded: {} is not looked for",
                                   column(Channel::kToolTemperature),
                                   gap::name_of(gap::Effect::kContactTemperatureDependence)));
  if (signals.is_current_driven)
    untested.push_back(fmt::format(
        "{} is not recorded: the current drives the spindle; what acts on the voltage and how late "
        "the current is shown are not looked for",
        column(Channel::kArmatureVoltage)));
  else if (is_evaluated(gap::Balance::kArmatureVoltage) &&
           !states_heat(machine.configuration.machine.spindle) && !signals.has(Channel::kWindingTemperature))
    untested.push_back(fmt::format(
        "{} is not recorded: it is taken from the square of the current, and {} and {} have no size",
        column(Channel::kWindingTemperature), gap::name_of(gap::Effect::kResistanceTemperatureDrift),
        gap::name_of(gap::Effect::kMagnetTemperatureDrift)));
  return untested;
}

}  // namespace morepro::host
