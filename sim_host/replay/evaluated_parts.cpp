#include "sim_host/replay/evaluated_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <initializer_list>

#include "lib/monitor/reason.hpp"

namespace morepro::host {
namespace {

/// What one part of the evaluation needs: all of some signals, and one of some others (0: of none).
struct Need {
  std::string_view name;
  bool MachineDescription::*described;
  std::string_view table;
  std::uint16_t all_of;
  std::uint16_t one_of;
  ReasonCode objection;  ///< what the monitor says where this part of the model does not fit
};

constexpr std::array kBalances{
    Need{"spindle torque balance", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kSpindleSpeed, Channel::kArmatureCurrent}), 0, ReasonCode::kNone},
    Need{"armature voltage balance", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent}), 0,
         ReasonCode::kNone},
    Need{"spindle response (both balances in one)", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kArmatureVoltage}), bits_of({Channel::kSpindleSpeed, Channel::kArmatureCurrent}),
         ReasonCode::kModelResidual},
    Need{"feed force balance", &MachineDescription::has_feed, "[feed]", bits_of({Channel::kFeedForce}),
         bits_of({Channel::kFeedSpeed, Channel::kFeedPosition}), ReasonCode::kModelFeedResidual},
};

constexpr std::uint16_t kChipLoadChannels = bits_of(
    {Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kContact});

std::string columns(unsigned bits, std::string_view separator) {
  std::string names;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (bits & (1U << i)) names += fmt::format("{}{}", names.empty() ? "" : separator, kChannels[i].column);
  }
  return names;
}

std::string missing(const Need& need, std::uint16_t seen) {
  std::string names = columns(need.all_of & ~unsigned{seen}, ", ");
  if (need.one_of == 0 || (need.one_of & seen) != 0) return names;
  return fmt::format("{}{}{}", names, names.empty() ? "" : ", ", columns(need.one_of, " or "));
}

bool has_objection(const Need& need, const Health& health) {
  return need.objection != ReasonCode::kNone && health.reason == static_cast<std::uint16_t>(need.objection);
}

EvaluatedPart evaluate(const Need& need, const MachineDescription& machine, const ReplayResult& result) {
  const std::string absent = missing(need, result.seen);
  EvaluatedPart part{.name = std::string(need.name), .is_evaluated = false, .reason = {}};
  if (!(machine.*need.described)) {
    part.reason = fmt::format("the machine file describes no {}", need.table);
  } else if (!absent.empty()) {
    part.reason = fmt::format("not recorded: {}", absent);
  } else {
    part.is_evaluated = true;
    if (has_objection(need, result.last)) part.reason = text_of(need.objection).sentence;
  }
  return part;
}

EvaluatedPart evaluate_chip_load(const MachineDescription& machine, const ReplayResult& result) {
  EvaluatedPart part{.name = "chip load and wear", .is_evaluated = result.has_chip_load(), .reason = {}};
  const std::string absent = columns(kChipLoadChannels & ~unsigned{result.seen}, ", ");
  if (part.is_evaluated) return part;
  if (!machine.has_spindle || !machine.has_contact) {
    part.reason = "the machine file must describe [spindle], [tool] and [contact]";
  } else if (!absent.empty()) {
    part.reason = fmt::format("not recorded: {}", absent);
  } else {
    part.reason = text_of(static_cast<ReasonCode>(result.last.reason)).sentence;
  }
  return part;
}

}  // namespace

bool can_judge_tool(const MachineDescription& machine, const ReplayResult& result) {
  return machine.has_spindle && machine.has_contact && (kChipLoadChannels & ~unsigned{result.seen}) == 0;
}

std::vector<EvaluatedPart> evaluated_parts(const MachineDescription& machine, const ReplayResult& result) {
  std::vector<EvaluatedPart> parts;
  for (const Need& need : kBalances) parts.push_back(evaluate(need, machine, result));
  parts.push_back(evaluate_chip_load(machine, result));
  return parts;
}

}  // namespace morepro::host
