#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/cli/command.hpp"
#include "sim_host/diagnose/diagnosis.hpp"
#include "sim_host/diagnose/result/diagnosis_json.hpp"
#include "sim_host/diagnose/signals/recording_loader.hpp"
#include "sim_host/machine/machine_file_writer.hpp"
#include "sim_host/replay/replay_session.hpp"
#include "sim_host/report/signals_report.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/output_file.hpp"
#include "sim_host/support/progress.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

constexpr const char* kDiagnoseExamples =
    "  morepro simulate --profile rich --duration 2 --effect brush_voltage_drop=1 \\\n"
    "    --datasheet-error 0.1 --machine-out datasheet.toml --out run.csv\n"
    "  morepro diagnose run.csv --machine datasheet.toml --apply found.toml\n"
    "  morepro diagnose run.csv --machine datasheet.toml --report gap.html\n"
    "  morepro diagnose run.csv --bootstrap 0 --exclude drive_lag --exclude shaft_compliance --json - | head";

struct DiagnoseArguments {
  std::string recording;
  std::string machine;
  std::string json;
  std::string out;
  std::string apply;
  std::string report;
  std::vector<std::string> exclude;
  int bootstrap_runs = 200;
  std::uint64_t seed = 1;
  std::string progress = "auto";
};

gap::Effect effect_of(const std::string& name) {
  if (const auto effect = gap::effect_named(name)) return *effect;
  std::vector<std::string_view> names;
  for (const auto& info : gap::kEffects) names.push_back(info.name);
  throw UsageError(fmt::format("--exclude: there is no effect '{}'{}; 'morepro effects' lists them", name,
                               did_you_mean(name, names)));
}

/// No axis or motor shows itself in so few rows; with milliseconds for seconds the search goes on for
/// minutes.
void check_rate(const RecordingInfo& info) {
  constexpr double kLeastHz = 20.0;
  if (!(info.rate_hz < kLeastHz)) return;
  throw UserError(fmt::format(
      "{}: the recording is sampled at {:g} Hz, a diagnosis needs {:g} Hz; record at such a rate, or "
      "correct its time_s, which is in s",
      info.file, info.rate_hz, kLeastHz));
}

/// The line of progress is gone when this returns: what is printed next has the terminal for itself.
DiagnosisResult diagnosed(RecordingSignals signals, const MachineDescription& machine,
                          DiagnosisOptions& options, bool is_shown, MachineDescription& with_effects) {
  StageProgress progress("diagnose", is_shown);
  options.on_progress = [&progress](double share) { progress.show("effects", share); };
  return diagnose(std::move(signals), machine, options, with_effects);
}

void run(const DiagnoseArguments& arguments) {
  check_distinct({{"the recording", arguments.recording}, {"--machine", arguments.machine}},
                 {{"--out", arguments.out},
                  {"--json", arguments.json},
                  {"--apply", arguments.apply},
                  {"--report", arguments.report}});
  std::optional<SignalsReport> report;
  if (!arguments.report.empty()) report.emplace("diagnose");
  DiagnosisOptions options{
      .bootstrap_runs = arguments.bootstrap_runs, .excluded = {}, .seed = arguments.seed};
  for (const std::string& name : arguments.exclude) options.excluded.push_back(effect_of(name));
  RecordingReader recording(arguments.recording);
  check_rate(recording.info());
  std::vector<std::string> notices = recording.info().warnings;
  const MachineDescription machine = machine_for(recording, arguments.machine, notices);
  for (const std::string& notice : notices) warn(notice);
  const auto out = open_if_asked(arguments.out);
  const auto json = open_if_asked(arguments.json);
  const auto applied = open_if_asked(arguments.apply);
  const auto page = open_if_asked(arguments.report);
  RecordingSignals signals = load_signals(recording, machine.usable_channels());
  for (const std::string& notice : impossible_samples(signals)) warn(notice);
  check_contact(signals, machine);
  if (report) {
    report->take_recording(signals, machine);
    options.on_axis = [&report](const AxisDiagnosis& axis) { report->take(axis); };
  }
  MachineDescription with_effects;
  DiagnosisResult result =
      diagnosed(std::move(signals), machine, options, arguments.progress != "off", with_effects);
  result.file = recording.info().file;
  for (const std::string& notice : result.notices) warn(notice);
  const std::string text = diagnosis_json(result);
  if (json) json->write(text);
  if (page) page->write(report->html(text, command_line(), {arguments.recording, arguments.machine}));
  if (applied) applied->write(machine_file_text(with_effects));
  show_text(out.get(), {arguments.json, arguments.apply, arguments.report}, diagnosis_text(result));
  if (json) json->commit();
  if (applied) applied->commit();
  if (page) page->commit();
}

}  // namespace

void add_diagnose(CLI::App& program) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = program.add_subcommand(
      "diagnose", "find where the model is wrong, which effect explains it and how far it shrinks with it");
  command->add_option("recording", arguments->recording, "recording, .csv, .mrec, .mat or .mcap")->required();
  command->add_option(
      "--machine", arguments->machine,
      "'reference', 'thesis' or a machine file, the datasheet; the recording's own by default");
  command
      ->add_option("--bootstrap", arguments->bootstrap_runs,
                   "runs that tell what chance looks like in this recording; 0 switches it off")
      ->check(between(0, 100000, ""))
      ->capture_default_str();
  command->add_option("--exclude", arguments->exclude, "take an effect out of the catalogue; repeatable");
  add_text_option(*command, arguments->out);
  command->add_option("--json", arguments->json, "write the result as JSON; '-': on standard output");
  command->add_option("--apply", arguments->apply, "write the machine with what was found (TOML)");
  add_report_option(*command, arguments->report);
  command->add_option("--seed", arguments->seed, "of the bootstrap")
      ->check(whole_number())
      ->capture_default_str();
  add_progress_option(*command, arguments->progress);
  add_examples(*command, "", kDiagnoseExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
