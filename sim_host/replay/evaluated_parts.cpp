#include "sim_host/replay/evaluated_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <initializer_list>

#include "lib/monitor/reason.hpp"

namespace morepro::host {
namespace {

/// What one part of the evaluation needs: all of some signals, and one of some others.
struct Need {
  std::string_view name;
  Parameter witness;  ///< the monitor tracks it when the balance is evaluated
  bool MachineDescription::*described;
  std::string_view table;
  Channel always;
  std::array<Channel, 2> one_of;
};

constexpr std::array kBalances{
    Need{"spindle torque balance",
         Parameter::kInertia,
         &MachineDescription::has_spindle,
         "[spindle]",
         Channel::kArmatureVoltage,
         {Channel::kSpindleSpeed, Channel::kArmatureCurrent}},
    Need{"armature voltage balance",
         Parameter::kResistance,
         &MachineDescription::has_spindle,
         "[spindle]",
         Channel::kArmatureVoltage,
         {Channel::kSpindleSpeed, Channel::kArmatureCurrent}},
    Need{"feed force balance",
         Parameter::kMass,
         &MachineDescription::has_feed,
         "[feed]",
         Channel::kFeedForce,
         {Channel::kFeedSpeed, Channel::kFeedPosition}},
};

constexpr std::array kChipLoadChannels{Channel::kArmatureVoltage, Channel::kSpindleSpeed,
                                       Channel::kArmatureCurrent, Channel::kContact};

template <typename Channels>
std::string missing_columns(const Channels& channels, std::uint16_t recorded) {
  std::string names;
  unsigned seen = recorded;
  for (const Channel channel : channels) {
    if (seen & bit_of(channel)) continue;
    seen |= bit_of(channel);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", info_of(channel).column);
  }
  return names;
}

std::string missing_columns(const Need& need, std::uint16_t recorded) {
  if (!(recorded & bit_of(need.always))) return std::string(info_of(need.always).column);
  const auto& [first, second] = need.one_of;
  if (recorded & (bit_of(first) | bit_of(second))) return {};
  return fmt::format("{} or {}", info_of(first).column, info_of(second).column);
}

EvaluatedPart evaluate(const Need& need, const MachineDescription& machine, const ReplayResult& result) {
  EvaluatedPart part{.name = std::string(need.name), .is_evaluated = false, .reason = {}};
  const std::string missing = missing_columns(need, result.info.recorded);
  const auto& witness = result.last.parameters[static_cast<std::size_t>(need.witness)];
  if (!(machine.*need.described)) {
    part.reason = fmt::format("the machine file describes no {}", need.table);
  } else if (!missing.empty()) {
    part.reason = fmt::format("not recorded: {}", missing);
  } else if (witness.status == ParameterStatus::kNoSignal) {
    part.reason = "its signals were recorded, but the monitor could not use them";
  } else {
    part.is_evaluated = true;
  }
  return part;
}

EvaluatedPart evaluate_chip_load(const MachineDescription& machine, const ReplayResult& result) {
  EvaluatedPart part{.name = "chip load and wear", .is_evaluated = result.has_chip_load(), .reason = {}};
  const std::string missing = missing_columns(kChipLoadChannels, result.info.recorded);
  if (part.is_evaluated) return part;
  if (!machine.has_spindle || !machine.has_contact) {
    part.reason = "the machine file must describe [spindle], [tool] and [contact] for it";
  } else if (!missing.empty()) {
    part.reason = fmt::format("not recorded: {}", missing);
  } else {
    part.reason = text_of(static_cast<ReasonCode>(result.last.reason)).sentence;
  }
  return part;
}

}  // namespace

std::vector<EvaluatedPart> evaluated_parts(const MachineDescription& machine, const ReplayResult& result) {
  std::vector<EvaluatedPart> parts;
  for (const Need& need : kBalances) parts.push_back(evaluate(need, machine, result));
  parts.push_back(evaluate_chip_load(machine, result));
  return parts;
}

}  // namespace morepro::host
