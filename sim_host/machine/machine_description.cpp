#include "sim_host/machine/machine_description.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <initializer_list>

#include "sim_host/machine/machine_file_reader.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 2> kBuiltIn{"reference", "thesis"};

constexpr std::uint16_t kSpindleChannels =
    bits_of({Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kSpindleAngle,
             Channel::kArmatureCurrent, Channel::kWindingTemperature, Channel::kSpindleAcceleration});
constexpr std::uint16_t kFeedChannels =
    bits_of({Channel::kFeedForce, Channel::kFeedSpeed, Channel::kFeedPosition, Channel::kFeedAcceleration});
constexpr std::uint16_t kContactChannels = bits_of({Channel::kContact, Channel::kEngagement});

}  // namespace

std::uint16_t MachineDescription::usable_channels() const {
  unsigned bits = kContactChannels;
  if (has_spindle) bits |= kSpindleChannels;
  if (has_feed) bits |= kFeedChannels;
  if (has_contact) bits |= bit_of(Channel::kChipLoad);
  if (has_contact && has_thermal) bits |= bit_of(Channel::kToolTemperature);
  return static_cast<std::uint16_t>(bits);
}

bool is_built_in_name(std::string_view name) { return name == kBuiltIn[0] || name == kBuiltIn[1]; }

MachineDescription built_in_machine(std::string_view name) {
  if (!is_built_in_name(name)) {
    throw UsageError(fmt::format("'{}' is no built-in machine{}", name, did_you_mean(name, kBuiltIn)));
  }
  MachineDescription machine;
  machine.name = name;
  machine.configuration = name == "thesis" ? thesis_configuration() : reference_configuration();
  return machine;
}

MachineDescription load_machine(const std::string& name_or_path) {
  if (is_built_in_name(name_or_path)) return built_in_machine(name_or_path);
  const bool is_path =
      std::filesystem::exists(name_or_path) || name_or_path.find_first_of("./") != std::string::npos;
  if (is_path) return read_machine_file(name_or_path);
  throw UsageError(
      fmt::format("--machine {}: neither a built-in machine ('reference', 'thesis') nor a file{}",
                  name_or_path, did_you_mean(name_or_path, kBuiltIn)));
}

}  // namespace morepro::host
