#include "sim_host/replay/replay_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "firmware/app.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/replay/evaluated_parts.hpp"
#include "sim_host/replay/replay_board.hpp"
#include "sim_host/replay/result_collector.hpp"

namespace morepro::host {
namespace {

using ReplayApp = firmware::App<ReplayBoard>;

/// Where in the machine file the monitor's key stands, or the key that its value was chosen from.
TextPlace place_of(const MachineDescription& machine, std::string_view key) {
  constexpr std::pair<std::string_view, std::string_view> kOrigins[] = {
      {"grid.first_mm", "bank.first_hypothesis_mm"},
      {"grid.first_mm", "tool.chip_load_mm"},
      {"grid.step_mm", "bank.hypothesis_step_mm"},
      {"grid.step_mm", "tool.chip_load_mm"},
      {"tuning.chip_load_drift_mm", "bank.hypothesis_step_mm"},
      {"tuning.chip_load_drift_mm", "tool.chip_load_mm"},
      {"tuning.speed_process_noise_rad_s", "sensors.spindle_speed_rad_s.noise"},
      {"tuning.current_process_noise_a", "sensors.armature_current_a.noise"},
      {"tuning.feed_process_noise_m_s", "sensors.feed_speed_m_s.noise"},
      {"gap.speed_process_noise_rad_s", "sensors.spindle_speed_rad_s.noise"},
      {"gap.current_process_noise_a", "sensors.armature_current_a.noise"},
      {"gap.feed_process_noise_m_s", "sensors.feed_speed_m_s.noise"}};
  if (const auto own = machine.places.find(key); own != machine.places.end()) return own->second;
  for (const auto& [chosen, origin] : kOrigins) {
    const auto place = machine.places.find(origin);
    if (chosen == key && place != machine.places.end()) return place->second;
  }
  return {};
}

// Machine files and built-in machines have a possible rate: another one is the recording's.
void check_rate(const MachineDescription& machine, const RecordingInfo& info) {
  const double rate_hz = machine.configuration.sampling.rate_hz;
  if (rate_hz >= 100.0 && rate_hz <= 20000.0) return;
  throw UserError(fmt::format(
      "{}: the recording is sampled at {:g} Hz, the monitor needs 100 .. 20000 Hz; record at such a "
      "rate, or correct its time_s",
      info.file, rate_hz));
}

void check_configuration(const MachineDescription& machine) {
  const ConfigurationResult result = std::make_unique<BoardMonitor>()->configure(machine.configuration);
  if (result.ok()) return;
  const std::string sentence =
      fmt::format("the monitor refuses machine '{}'{}{}: {}", machine.name,
                  result.key.empty() ? "" : " because of ", result.key, text_of(result.error));
  const TextPlace place = place_of(machine, result.key);
  if (place.file.empty()) throw UserError(sentence);
  throw UserError(place, sentence);
}

// Without a contact law a spindle in contact has a torque that nobody described.
void check_contact(const MachineDescription& machine, const RecordingReader& recording,
                   const SensorFrame& frame) {
  if (!machine.has_spindle || machine.has_contact) return;
  if (!frame.has(Channel::kContact) || frame.get(Channel::kContact) == 0.0F) return;
  throw UserError(
      fmt::format("{}: the tool is in contact at {:.6f} s, but machine '{}' describes no contact; add "
                  "[tool] and [contact] to its file",
                  recording.info().file, seconds(recording.info().start_us) + recording.tally().duration_s,
                  machine.name));
}

}  // namespace

ReplayResult replay(RecordingReader& recording, const MachineDescription& machine,
                    const ReplayOutputs& outputs) {
  check_rate(machine, recording.info());
  check_configuration(machine);
  ReplayBoard board(recording, machine.configuration, machine.usable_channels(), outputs.answers);
  const auto app = std::make_unique<ReplayApp>(board);
  ResultCollector collector(recording.info().start_us);
  const auto start = std::chrono::steady_clock::now();
  if (!app->start()) throw UserError("the monitor took no configuration; this is a fault of the program");
  while (app->pass()) {
    if (!board.has_new_frame()) continue;
    check_contact(machine, recording, board.last_frame());
    collector.take(board.last_frame(), app->monitor());
    if (outputs.on_frame) outputs.on_frame(board.last_frame(), app->monitor());
  }
  ReplayResult result;
  result.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  collector.finish(app->monitor(), result);
  if (app->counters().corrupt > 0) result.reasons.emplace("corrupt", app->counters().corrupt);
  result.info = recording.info();
  result.tally = recording.tally();
  result.damage = recording.damage();
  result.machine_name = machine.name;
  result.has_spindle = machine.has_spindle;
  result.has_feed = machine.has_feed;
  result.has_contact = machine.has_contact;
  result.configuration = machine.configuration;
  result.parts = evaluated_parts(machine, result);
  result.can_judge_tool = can_judge_tool(machine, result);
  return result;
}

}  // namespace morepro::host
