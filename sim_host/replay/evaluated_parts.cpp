#include "sim_host/replay/evaluated_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <initializer_list>

#include "lib/monitor/reason.hpp"

namespace morepro::host {
namespace {

constexpr std::uint16_t bits_of(std::initializer_list<Channel> channels) {
  std::uint16_t bits = 0;
  for (const Channel channel : channels) bits = static_cast<std::uint16_t>(bits | bit_of(channel));
  return bits;
}

/// What one part of the evaluation needs: all of some signals, and one of some others (0: of none).
struct Need {
  std::string_view name;
  bool MachineDescription::*described;
  std::string_view table;
  std::uint16_t all_of;
  std::uint16_t one_of;
};

constexpr std::array kBalances{
    Need{"spindle torque balance", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kSpindleSpeed, Channel::kArmatureCurrent}), 0},
    Need{"armature voltage balance", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent}), 0},
    Need{"spindle response (both balances in one)", &MachineDescription::has_spindle, "[spindle]",
         bits_of({Channel::kArmatureVoltage}), bits_of({Channel::kSpindleSpeed, Channel::kArmatureCurrent})},
    Need{"feed force balance", &MachineDescription::has_feed, "[feed]", bits_of({Channel::kFeedForce}),
         bits_of({Channel::kFeedSpeed, Channel::kFeedPosition})},
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

EvaluatedPart evaluate(const Need& need, const MachineDescription& machine, std::uint16_t seen) {
  const std::string absent = missing(need, seen);
  EvaluatedPart part{.name = std::string(need.name), .is_evaluated = false, .reason = {}};
  if (!(machine.*need.described)) {
    part.reason = fmt::format("the machine file describes no {}", need.table);
  } else if (!absent.empty()) {
    part.reason = fmt::format("not recorded: {}", absent);
  } else {
    part.is_evaluated = true;
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

std::vector<EvaluatedPart> evaluated_parts(const MachineDescription& machine, const ReplayResult& result) {
  std::vector<EvaluatedPart> parts;
  for (const Need& need : kBalances) parts.push_back(evaluate(need, machine, result.seen));
  parts.push_back(evaluate_chip_load(machine, result));
  return parts;
}

}  // namespace morepro::host
