#include <fmt/format.h>

#include <cmath>

#include "lib/monitor/configuration_check.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/setting_key.hpp"
#include "sim_host/replay/replay_session.hpp"

namespace morepro::host {
namespace {

constexpr double kDescribedRateTolerance = 1.0e-3;

/// Those that are possible: whether all of them are is asked where the configuration is used.
void take_effects(const MonitorConfiguration& configuration, MachineDescription& machine) {
  const auto& [effect, count] = configuration.effects;
  for (std::size_t i = 0; i < count && i < effect.size(); ++i)
    if (check_effect(effect[i], configuration.sampling.rate_hz).ok()) machine.effects.push_back(effect[i]);
}

/// A recording does not say what was chosen: what is other than the choice was stated.
void state_what_differs(MachineDescription& machine) {
  const MonitorConfiguration chosen = chosen_for(machine.configuration, machine.has_contact);
  for (const SettingKey& key : setting_keys()) {
    const double value = key.get(machine.configuration);
    if (std::fabs(value - key.get(chosen)) > 1e-9 * std::fabs(value)) machine.stated.insert(full_name(key));
  }
}

MachineDescription choose(const RecordingReader& recording, const std::string& asked_for,
                          std::vector<std::string>& notices) {
  if (!asked_for.empty()) return load_machine(asked_for);
  const std::string_view name = recording.info().metadata_value("machine");
  if (const auto configuration = recording.configuration()) {
    MachineDescription machine;
    machine.name = name.empty() ? "of the recording" : std::string(name);
    machine.configuration = *configuration;
    take_effects(*configuration, machine);
    state_what_differs(machine);
    return machine;
  }
  if (is_built_in_name(name)) return built_in_machine(name);
  notices.push_back(
      fmt::format("{}: no --machine was given and the recording names none that is built in; the "
                  "'reference' machine is assumed",
                  recording.info().file));
  return built_in_machine("reference");
}

void take_rate(MachineDescription& machine, const RecordingInfo& info, std::vector<std::string>& notices) {
  const double described_hz = machine.configuration.sampling.rate_hz;
  if (std::fabs(info.rate_hz / described_hz - 1.0) <= kDescribedRateTolerance) return;
  if (!machine.is_built_in && machine.has_rate) {
    notices.push_back(
        fmt::format("{}: sampled at {} Hz, the machine file says {} Hz; the recording's rate is used",
                    info.file, info.rate_hz, described_hz));
  }
  set_rate(machine.configuration, info.rate_hz);
}

void note_assumed_noise(const MachineDescription& machine, const RecordingInfo& info,
                        std::vector<std::string>& notices) {
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (!(info.recorded & machine.assumed_noise & bit_of(static_cast<Channel>(i)))) continue;
    notices.push_back(fmt::format("machine '{0}' has no [sensors.{1}]; a noise of {2} is assumed",
                                  machine.name, kChannels[i].column,
                                  machine.configuration.sensors[static_cast<Channel>(i)].noise));
  }
}

// The models take an input as what acts. What it shakes beyond is estimated with the rest of the process noise.
void note_unused_noise(const MachineDescription& machine, std::vector<std::string>& notices) {
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const bool is_input = kChannels[i].kind == ChannelKind::kHeldInput;
    if (!is_input || !(machine.configuration.sensors[static_cast<Channel>(i)].variance() > 0.0)) continue;
    notices.push_back(fmt::format("machine '{0}': [sensors.{1}] is not used; {1} is an input, taken as it is",
                                  machine.name, kChannels[i].column));
  }
}

}  // namespace

MachineDescription machine_for(const RecordingReader& recording, const std::string& name_or_path,
                               std::vector<std::string>& notices) {
  MachineDescription machine = choose(recording, name_or_path, notices);
  // A native recording is replayed with exactly the configuration that it was made with: the same bits.
  const bool is_recorded_machine = name_or_path.empty() && recording.configuration().has_value();
  if (!is_recorded_machine) take_rate(machine, recording.info(), notices);
  note_assumed_noise(machine, recording.info(), notices);
  note_unused_noise(machine, notices);
  return machine;
}

}  // namespace morepro::host
