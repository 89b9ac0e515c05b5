#include "sim_host/replay/replay_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "firmware/app.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "sim_host/replay/evaluated_parts.hpp"
#include "sim_host/replay/replay_board.hpp"
#include "sim_host/replay/result_collector.hpp"

namespace morepro::host {
namespace {

using ReplayApp = firmware::App<ReplayBoard>;

void check_configuration(const MachineDescription& machine) {
  const ConfigurationResult result = std::make_unique<BoardMonitor>()->configure(machine.configuration);
  if (result.ok()) return;
  const std::string sentence =
      fmt::format("the monitor refuses machine '{}'{}{}: {}", machine.name,
                  result.key.empty() ? "" : " because of ", result.key, text_of(result.error));
  const auto place = machine.places.find(result.key);
  if (place == machine.places.end()) throw UserError(sentence);
  throw UserError(place->second, sentence);
}

// Without a contact law a spindle in contact has a torque that nobody described.
void check_contact(const MachineDescription& machine, const RecordingReader& recording,
                   const SensorFrame& frame) {
  if (!machine.has_spindle || machine.has_contact) return;
  if (!frame.has(Channel::kContact) || frame.get(Channel::kContact) == 0.0F) return;
  throw UserError(
      fmt::format("{}: the tool is in contact at {:.6f} s, but machine '{}' describes no contact; add "
                  "[tool] and [contact] to its file",
                  recording.info().file, recording.tally().duration_s, machine.name));
}

}  // namespace

ReplayResult replay(RecordingReader& recording, const MachineDescription& machine,
                    const ReplayOutputs& outputs) {
  check_configuration(machine);
  ReplayBoard board(recording, machine.configuration, machine.usable_channels(), outputs.answers);
  const auto app = std::make_unique<ReplayApp>(board);
  ResultCollector collector;
  const auto start = std::chrono::steady_clock::now();
  if (!app->start()) throw UserError("the monitor took no configuration; this is a fault of the program");
  while (app->pass()) {
    if (!board.has_new_frame()) continue;
    check_contact(machine, recording, board.last_frame());
    collector.take(board.last_frame(), app->monitor());
    if (outputs.on_frame) outputs.on_frame(app->monitor().health());
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
  result.configuration = machine.configuration;
  result.parts = evaluated_parts(machine, result);
  result.can_judge_tool = can_judge_tool(machine, result);
  return result;
}

}  // namespace morepro::host
