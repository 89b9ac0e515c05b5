#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/plant/contact_law.hpp"
#include "sim_host/cli/command.hpp"
#include "sim_host/diagnose/signals/recording_loader.hpp"
#include "sim_host/identify/identification.hpp"
#include "sim_host/machine/machine_file_writer.hpp"
#include "sim_host/replay/replay_session.hpp"
#include "sim_host/report/signals_report.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/output_file.hpp"
#include "sim_host/support/progress.hpp"

namespace morepro::host {
namespace {

constexpr const char* kIdentifyWords =
    "Spindle: armature_voltage_v, spindle_speed_rad_s, armature_current_a, and contact, chip_load_mm,\n"
    "tool_temperature_degc where there is a cut. Feed axis: feed_force_n, feed_speed_m_s or "
    "feed_position_m,\n"
    "contact, engagement.";

constexpr const char* kIdentifyExamples =
    "  morepro simulate --profile rich --duration 4 --datasheet-error 0.2 --machine-out datasheet.toml --out "
    "run.csv\n"
    "  morepro identify run.csv --machine datasheet.toml --apply identified.toml\n"
    "  morepro identify run.csv --filter derivatives";

struct IdentifyArguments {
  std::string recording;
  std::string machine;
  std::string filter = "states";
  std::string json;
  std::string out;
  std::string apply;
  std::string report;
  std::string progress = "auto";
};

/// Rows of the cut whose chip load the contact law was not fitted for.
std::size_t rows_outside_law(const RecordingSignals& signals, const MachineDescription& machine) {
  if (!machine.has_contact || !signals.has(Channel::kContact) || !signals.has(Channel::kChipLoad)) return 0;
  const auto& contact = signals.value[index_of(Channel::kContact)];
  const auto& chip_load = signals.value[index_of(Channel::kChipLoad)];
  std::size_t outside = 0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double chip_load_mm = static_cast<double>(chip_load[row]);
    if (contact[row] > 0.5F && !std::isnan(chip_load_mm) &&
        !is_inside_contact_range(machine.configuration.machine, chip_load_mm))
      ++outside;
  }
  return outside;
}

/// What the answer rests on and nobody measured.
void note_assumptions(const RecordingSignals& signals, const MachineDescription& machine) {
  if (!machine.effects.empty())
    warn(
        "the [[effects]] of the machine file are not part of this model; 'morepro diagnose' refits with "
        "them");
  if (!signals.has(Channel::kContact)) {
    if (machine.has_contact || machine.has_feed)
      warn("contact is not recorded; the tool is taken to be in the air");
    return;
  }
  if (machine.has_contact && signals.has(Channel::kSpindleSpeed) && !signals.has(Channel::kChipLoad))
    warn("chip_load_mm is not recorded; the machine's nominal one is taken for the torque of the cut");
  if (const std::size_t rows = rows_outside_law(signals, machine); rows > 0)
    warn(
        fmt::format("chip_load_mm is outside the range of the contact law in {} rows of the cut; the torque "
                    "there is that of the nearest one inside, and what is balanced with it may be as wrong",
                    rows));
  if (machine.has_feed && signals.has(Channel::kFeedForce) && !signals.has(Channel::kEngagement))
    warn("engagement is not recorded; the machine's nominal one is taken for the force of the cut");
}

/// The line of progress is gone when this returns: what is printed next has the terminal for itself.
IdentificationResult result_of(const RecordingSignals& signals, const MachineDescription& machine,
                               const IdentifyArguments& arguments) {
  StageProgress progress("identify", arguments.progress != "off");
  const auto filter =
      arguments.filter == "states" ? IdentificationFilter::kStates : IdentificationFilter::kDerivatives;
  int pass = 0;
  return identify(signals, machine, filter, [&](const std::string& stage) {
    progress.show(fmt::format("{}, pass {}", stage, ++pass), 0.0);
  });
}

bool is_any_identified(const IdentificationResult& result) {
  return std::any_of(result.parameters.begin(), result.parameters.end(),
                     [](const auto& parameter) { return parameter.is_identifiable; });
}

void run(const IdentifyArguments& arguments) {
  check_distinct({{"the recording", arguments.recording}, {"--machine", arguments.machine}},
                 {{"--out", arguments.out},
                  {"--json", arguments.json},
                  {"--apply", arguments.apply},
                  {"--report", arguments.report}});
  std::optional<SignalsReport> report;
  if (!arguments.report.empty()) report.emplace("identify");
  RecordingReader recording(arguments.recording);
  std::vector<std::string> notices = recording.info().warnings;
  const MachineDescription machine = machine_for(recording, arguments.machine, notices);
  for (const std::string& notice : notices) warn(notice);
  const auto out = open_if_asked(arguments.out);
  const auto json = open_if_asked(arguments.json);
  const auto applied = open_if_asked(arguments.apply);
  const auto page = open_if_asked(arguments.report);
  const RecordingSignals signals = load_signals(recording, machine.usable_channels());
  for (const std::string& notice : impossible_samples(signals)) warn(notice);
  check_contact(signals, machine);
  note_assumptions(signals, machine);
  IdentificationResult result = result_of(signals, machine, arguments);
  result.file = recording.info().file;
  if (applied && !is_any_identified(result))
    throw UserError(
        "nothing was identified, so there is nothing to apply; without --apply the reasons are shown");
  const std::string text = identification_json(result);
  const MachineDescription identified = identified_machine(machine, result);
  if (json) json->write(text);
  if (applied) applied->write(machine_file_text(identified));
  if (page) {
    report->take_recording(signals, machine);
    report->take(signals, machine, identified);
    page->write(report->html(text, command_line(), {arguments.recording, arguments.machine}));
  }
  show_text(out.get(), {arguments.json, arguments.apply, arguments.report}, identification_text(result));
  if (json) json->commit();
  if (applied) applied->commit();
  if (page) page->commit();
}

}  // namespace

void add_identify(CLI::App& program) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* command = program.add_subcommand(
      "identify", "find the machine's parameters: value, standard error, identifiable or why not");
  add_examples(*command, kIdentifyWords, kIdentifyExamples);
  command->add_option("recording", arguments->recording, "recording, .csv, .mrec, .mat or .mcap")->required();
  command->add_option(
      "--machine", arguments->machine,
      "'reference', 'thesis' or a machine file, the datasheet; the recording's own by default");
  command
      ->add_option(
          "--filter", arguments->filter,
          "'states': from speeds and current; 'derivatives': from their derivatives, as in the thesis")
      ->check(one_of({"states", "derivatives"}))
      ->capture_default_str();
  add_text_option(*command, arguments->out);
  command->add_option("--json", arguments->json, "write the result as JSON; '-': on standard output");
  command->add_option("--apply", arguments->apply,
                      "write the machine with the values that were identified (TOML)");
  add_report_option(*command, arguments->report);
  add_progress_option(*command, arguments->progress);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
