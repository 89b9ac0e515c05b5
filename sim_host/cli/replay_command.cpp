#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/machine/monitor_effects.hpp"
#include "sim_host/page/page.hpp"
#include "sim_host/replay/health_csv.hpp"
#include "sim_host/replay/replay_session.hpp"
#include "sim_host/replay/result_json.hpp"
#include "sim_host/replay/result_text.hpp"
#include "sim_host/report/replay_report.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/progress.hpp"
#include "sim_host/support/terminal.hpp"

namespace morepro::host {
namespace {

constexpr const char* kReplayExamples =
    "  morepro simulate --duration 2 --out run.csv\n"
    "  morepro replay run.csv\n"
    "  morepro replay run.csv --machine reference --json result.json --out frames.csv\n"
    "  morepro replay run.csv --report page.html\n"
    "  morepro replay run.csv --json - | head";

struct ReplayArguments {
  std::string recording;
  std::string machine;
  std::string rule;
  std::string json;
  std::string out;
  std::string health_out;
  std::string report;
  bool accept_damaged = false;
  std::string progress = "auto";
};

/// Every file that a replay writes: opened before the work, visible after it, all or none.
struct ReplayFiles {
  explicit ReplayFiles(const ReplayArguments& arguments)
      : json(open_if_asked(arguments.json)),
        frames(open_if_asked(arguments.out)),
        answers(open_if_asked(arguments.health_out)),
        report(open_if_asked(arguments.report)) {}

  void commit() const {
    for (OutputFile* file : {json.get(), frames.get(), answers.get(), report.get()}) {
      if (file != nullptr) file->commit();
    }
  }

  std::unique_ptr<OutputFile> json;
  std::unique_ptr<OutputFile> frames;
  std::unique_ptr<OutputFile> answers;
  std::unique_ptr<OutputFile> report;
};

void take_rule(const std::string& rule, MonitorConfiguration& configuration) {
  if (rule == "markov") configuration.rule = DecisionRule::kMarkov;
  if (rule == "bayesian") configuration.rule = DecisionRule::kBayesian;
  if (rule == "thesis") configuration.rule = DecisionRule::kThesis;
}

bool uses_stdout(const ReplayArguments& arguments) {
  return arguments.json == "-" || arguments.out == "-" || arguments.health_out == "-" ||
         arguments.report == "-";
}

ReplayResult replay_into(const ReplayFiles& files, RecordingReader& recording,
                         const MachineDescription& machine, ReplayReport* report, bool with_progress) {
  Progress progress("replay", recording.frame_count(), with_progress);
  std::optional<HealthCsv> rows;
  if (files.frames) rows.emplace(*files.frames, machine.configuration, recording.info().start_us);
  const auto on_frame = [&](const SensorFrame& frame, const BoardMonitor& monitor) {
    if (rows) rows->write(monitor.health());
    if (report != nullptr) report->take(frame, monitor);
    progress.advance();
  };
  return replay(recording, machine, {.answers = files.answers.get(), .on_frame = on_frame});
}

void run(const ReplayArguments& arguments) {
  check_distinct({{"the recording", arguments.recording}, {"--machine", arguments.machine}},
                 {{"--json", arguments.json},
                  {"--out", arguments.out},
                  {"--health-out", arguments.health_out},
                  {"--report", arguments.report}});
  if (const std::string why = why_no_page(k_report_page); !arguments.report.empty() && !why.empty())
    throw UserError(why);
  RecordingReader recording(arguments.recording);
  std::vector<std::string> notices;
  MachineDescription machine = machine_for(recording, arguments.machine, notices);
  know_effects(machine, notices);
  take_rule(arguments.rule, machine.configuration);
  if (recording.damage().empty()) {
    notices.insert(notices.begin(), recording.info().warnings.begin(), recording.info().warnings.end());
  }
  for (const std::string& notice : notices) warn(notice);

  const ReplayFiles files(arguments);
  std::optional<ReplayReport> report;
  if (files.report) report.emplace(recording, machine);
  const ReplayResult result =
      replay_into(files, recording, machine, report ? &*report : nullptr, arguments.progress == "auto");
  const std::string text = result_json(result);
  if (files.json) files.json->write(text);
  if (files.report)
    files.report->write(
        report->finish(result).html(text, command_line(), {arguments.recording, arguments.machine}));
  if (!uses_stdout(arguments)) fmt::print("{}", result_text(result, wants_colour(STDOUT_FILENO)));
  const bool is_accepted = result.damage.empty() || arguments.accept_damaged;
  if (is_accepted) files.commit();
  if (!is_accepted) {
    throw UserError(fmt::format("{}; --accept-damaged writes the outputs all the same", result.damage));
  }
}

}  // namespace

void add_replay(CLI::App& program) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = program.add_subcommand("replay", "feed a recording through the monitor of the board");
  command->add_option("recording", arguments->recording, "recording, .csv, .mrec, .mat or .mcap")->required();
  command->add_option("--machine", arguments->machine,
                      "'reference', 'thesis' or a machine file; the recording's own by default");
  command
      ->add_option("--rule", arguments->rule, "decision between the hypotheses; the machine's own by default")
      ->check(one_of({"markov", "bayesian", "thesis"}));
  command->add_option("--json", arguments->json, "write the result as JSON; '-': on standard output");
  command->add_option("--out", arguments->out, "write the answer to every frame as CSV");
  command->add_option("--health-out", arguments->health_out, "write the messages that the board would send");
  add_report_option(*command, arguments->report);
  command->add_flag("--accept-damaged", arguments->accept_damaged,
                    "a recording that is cut or damaged is no error; write the outputs");
  add_progress_option(*command, arguments->progress);
  add_examples(*command, "", kReplayExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
