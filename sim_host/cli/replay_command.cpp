#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/machine/monitor_effects.hpp"
#include "sim_host/replay/health_csv.hpp"
#include "sim_host/replay/replay_session.hpp"
#include "sim_host/replay/result_json.hpp"
#include "sim_host/replay/result_text.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/progress.hpp"

namespace morepro::host {
namespace {

struct ReplayArguments {
  std::string recording;
  std::string machine;
  std::string rule;
  std::string json;
  std::string out;
  std::string health_out;
  bool accept_damaged = false;
  std::string progress = "auto";
};

/// Every file that a replay writes: opened before the work, visible after it, all or none.
struct ReplayFiles {
  explicit ReplayFiles(const ReplayArguments& arguments)
      : json(open_if_asked(arguments.json)),
        frames(open_if_asked(arguments.out)),
        answers(open_if_asked(arguments.health_out)) {}

  void commit() const {
    for (OutputFile* file : {json.get(), frames.get(), answers.get()}) {
      if (file != nullptr) file->commit();
    }
  }

  std::unique_ptr<OutputFile> json;
  std::unique_ptr<OutputFile> frames;
  std::unique_ptr<OutputFile> answers;
};

void take_rule(const std::string& rule, MonitorConfiguration& configuration) {
  if (rule == "markov") configuration.rule = DecisionRule::kMarkov;
  if (rule == "bayesian") configuration.rule = DecisionRule::kBayesian;
  if (rule == "thesis") configuration.rule = DecisionRule::kThesis;
}

bool wants_colour() { return isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr; }

bool uses_stdout(const ReplayArguments& arguments) {
  return arguments.json == "-" || arguments.out == "-" || arguments.health_out == "-";
}

ReplayResult replay_into(const ReplayFiles& files, RecordingReader& recording,
                         const MachineDescription& machine, bool with_progress) {
  Progress progress("replay", recording.frame_count(), with_progress);
  std::optional<HealthCsv> rows;
  if (files.frames) rows.emplace(*files.frames, machine.configuration, recording.info().start_us);
  const auto on_frame = [&](const Health& health) {
    if (rows) rows->write(health);
    progress.advance();
  };
  return replay(recording, machine, {.answers = files.answers.get(), .on_frame = on_frame});
}

void run(const ReplayArguments& arguments) {
  check_distinct(
      {{"the recording", arguments.recording}, {"--machine", arguments.machine}},
      {{"--json", arguments.json}, {"--out", arguments.out}, {"--health-out", arguments.health_out}});
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
  const ReplayResult result = replay_into(files, recording, machine, arguments.progress == "auto");
  if (files.json) files.json->write(result_json(result));
  if (!uses_stdout(arguments)) fmt::print("{}", result_text(result, wants_colour()));
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
      ->check(CLI::IsMember({"markov", "bayesian", "thesis"}));
  command->add_option("--json", arguments->json, "write the result as JSON; '-': on standard output");
  command->add_option("--out", arguments->out, "write the answer to every frame as CSV");
  command->add_option("--health-out", arguments->health_out, "write the messages that the board would send");
  command->add_flag("--accept-damaged", arguments->accept_damaged,
                    "a recording that is cut or damaged is no error; write the outputs");
  add_progress_option(*command, arguments->progress);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
