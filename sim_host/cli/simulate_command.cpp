#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/machine/machine_file_writer.hpp"
#include "sim_host/machine/monitor_effects.hpp"
#include "sim_host/recording/recording_format.hpp"
#include "sim_host/recording/recording_writer.hpp"
#include "sim_host/simulate/datasheet.hpp"
#include "sim_host/simulate/effect_option.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/simulate/simulation.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/progress.hpp"

namespace morepro::host {
namespace {

constexpr const char* kSimulateExamples =
    "  morepro simulate --profile rich --duration 4 --effect feed_coulomb_friction=8 --out gap.csv\n"
    "  morepro simulate --effect drive_lag=1e-3,from=2 --seed 7 --out late.mrec\n"
    "  morepro simulate --machine thesis --datasheet-error 0.2 --machine-out datasheet.toml --out run.mat\n"
    "  morepro simulate --duration 1 --out - | head";

struct SimulateArguments {
  std::string machine = "reference";
  std::string profile = "cutting";
  double duration_s = 5.0;
  double rate_hz = 0.0;
  std::vector<std::string> effects;
  double process_noise = 0.0;
  double datasheet_error = 0.0;
  std::string machine_out;
  std::uint64_t seed = 1;
  std::string out;
  std::string progress = "auto";
};

SimulationOptions options_of(const SimulateArguments& arguments, double default_rate_hz) {
  const auto profile = std::find(kProfileNames.begin(), kProfileNames.end(), arguments.profile);
  return {.profile = static_cast<ProfileKind>(profile - kProfileNames.begin()),
          .duration_s = arguments.duration_s,
          .rate_hz = arguments.rate_hz > 0.0 ? arguments.rate_hz : default_rate_hz,
          .seed = arguments.seed,
          .process_noise = arguments.process_noise};
}

void set_effects(const SimulateArguments& arguments, const MachineDescription& description,
                 SimulationOptions& options) {
  const MachineParameters& machine = description.configuration.machine;
  options.effects = description.effects;
  for (const gap::AppliedEffect& effect : options.effects) {
    if (const std::string objection = objection_to_rate(effect, options.rate_hz); !objection.empty())
      throw UserError(fmt::format("machine '{}': {}", description.name, objection));
  }
  const gap::EffectScales<double> scales(machine, reference_point_of(machine));
  const EffectLimits limits{options.duration_s, options.rate_hz};
  for (const std::string& text : arguments.effects)
    options.effects.push_back(effect_from_option(text, scales, limits));
}

Metadata metadata_of(const SimulateArguments& arguments, const MachineDescription& machine, double rate_hz) {
  return {{"machine", machine.name},
          {"source", "simulated"},
          {"profile", arguments.profile},
          {"seed", std::to_string(arguments.seed)},
          {"rate_hz", fmt::format("{}", rate_hz)}};
}

void check_described(const MachineDescription& machine) {
  if (machine.has_spindle && machine.has_feed && machine.has_contact) return;
  throw UserError(
      fmt::format("machine '{}' cannot be simulated: its file must describe [spindle], [feed], [tool] and "
                  "[contact]",
                  machine.name));
}

void write_machine(const SimulateArguments& arguments, MachineDescription machine, OutputFile& file) {
  machine.configuration.machine =
      datasheet_of(machine.configuration.machine, arguments.datasheet_error, arguments.seed);
  file.write(machine_file_text(machine));
}

void run(const SimulateArguments& arguments) {
  check_distinct({{"--machine", arguments.machine}},
                 {{"--out", arguments.out}, {"--machine-out", arguments.machine_out}});
  MachineDescription machine = load_machine(arguments.machine);
  check_described(machine);
  SimulationOptions options = options_of(arguments, machine.configuration.sampling.rate_hz);
  set_effects(arguments, machine, options);
  set_rate(machine.configuration, options.rate_hz);
  std::vector<std::string> notices;
  know_effects(machine, notices);
  // Only a native recording holds a machine: what its monitor knows does not matter there.
  if (format_of(arguments.out) != RecordingFormat::kNative) notices.clear();
  for (const std::string& notice : notices) warn(notice);
  Simulation simulation(machine.configuration, options);
  if (simulation.frame_count() < 2)
    throw UsageError("--duration times --rate gives fewer than two frames; raise one");

  OutputFile recording(arguments.out);
  std::unique_ptr<OutputFile> datasheet;
  if (!arguments.machine_out.empty()) datasheet = std::make_unique<OutputFile>(arguments.machine_out);
  RecordingInfo info;
  info.metadata = metadata_of(arguments, machine, options.rate_hz);
  info.recorded = simulation.recorded();
  RecordingWriter writer(recording, info, machine.configuration);
  Progress progress("simulate", simulation.frame_count(), arguments.progress == "auto");
  for (SensorFrame frame; simulation.next(frame); progress.advance()) writer.write(frame);
  writer.finish();
  if (datasheet) write_machine(arguments, machine, *datasheet);
  if (datasheet) datasheet->commit();
  recording.commit();
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = program.add_subcommand("simulate", "run a simulated machine and write a recording");
  command->add_option("--machine", arguments->machine, "'reference', 'thesis' or a machine file")
      ->capture_default_str();
  command->add_option("--profile", arguments->profile, "what the machine does")
      ->check(one_of(std::vector<std::string>(kProfileNames.begin(), kProfileNames.end())))
      ->capture_default_str();
  command->add_option("--duration", arguments->duration_s, "length of the recording in s")
      ->check(between(0.001, 86400.0, "s"))
      ->capture_default_str();
  command->add_option("--rate", arguments->rate_hz, "samples per second; the machine's own by default")
      ->check(between(100.0, 20000.0, "Hz"));
  command
      ->add_option("--effect", arguments->effects,
                   "NAME=SIZE[,from=SECONDS]: what this machine has beyond its model; repeatable, 'morepro "
                   "effects' lists names and units")
      ->expected(1)
      ->take_all();
  command
      ->add_option(
          "--process-noise", arguments->process_noise,
          "random load, feed force and supply ripple that nobody records, correlated over 1 ms; with 1 "
          "each would move its signal by one standard deviation of its sensor within 1 ms")
      ->check(between(0.0, 10.0, ""))
      ->capture_default_str();
  command
      ->add_option("--datasheet-error", arguments->datasheet_error,
                   "fraction by which --machine-out is wrong in every parameter")
      ->check(between(0.0, 0.9, ""))
      ->capture_default_str();
  command->add_option("--machine-out", arguments->machine_out, "write the machine's datasheet (TOML)");
  command->add_option("--seed", arguments->seed, "of noise and dither")
      ->check(whole_number())
      ->capture_default_str();
  command
      ->add_option("--out", arguments->out,
                   "recording to write, .csv, .mrec, .mat or .mcap; '-': CSV on standard output")
      ->required();
  add_progress_option(*command, arguments->progress);
  add_examples(*command, "", kSimulateExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
