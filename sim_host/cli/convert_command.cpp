#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/machine/monitor_effects.hpp"
#include "sim_host/recording/recording_format.hpp"
#include "sim_host/recording/recording_writer.hpp"
#include "sim_host/replay/replay_session.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/progress.hpp"

namespace morepro::host {
namespace {

constexpr const char* kConvertWords =
    ".mat: MATLAB, written as version 5, read up to 7.3, one column vector per signal. .mcap: for Foxglove "
    "and\n"
    "PlotJuggler, JSON messages on the topic /morepro/frame. A MATLAB file with names of its own:\n"
    "--map time_s=t --map feed_position_m=qm --map 'feed_force_n=gtau*vir'";

constexpr const char* kConvertExamples =
    "  morepro simulate --duration 1 --out run.csv\n"
    "  morepro convert run.csv run.mcap\n"
    "  morepro convert run.csv run.mrec --machine reference\n"
    "  morepro convert run.csv run.mat\n"
    "  morepro convert run.mat half.csv --map 'feed_force_n=0.5*feed_force_n'";

struct ConvertArguments {
  std::string in;
  std::string out;
  std::string machine;
  std::vector<std::string> map;
  double rate_hz = 0.0;
  bool accept_damaged = false;
  std::string progress = "auto";
};

/// Frames that the format of the output could not hold.
std::uint64_t copy(RecordingReader& in, RecordingWriter& out, Progress& progress) {
  std::uint64_t left_out = 0;
  SensorFrame frame;
  for (auto status = in.next(frame); status != hal::ReadStatus::kEnd; status = in.next(frame)) {
    if (status == hal::ReadStatus::kFrame && !out.write(frame)) ++left_out;
    progress.advance();
  }
  return left_out;
}

void run(const ConvertArguments& arguments) {
  check_distinct({{"in", arguments.in}, {"--machine", arguments.machine}}, {{"out", arguments.out}});
  RecordingReader in(arguments.in, {.sources = column_sources(arguments.map), .rate_hz = arguments.rate_hz});
  std::vector<std::string> notices;
  MachineDescription machine = machine_for(in, arguments.machine, notices);
  know_effects(machine, notices);
  // Only a native recording holds a machine: what was assumed about it does not matter there.
  if (format_of(arguments.out) != RecordingFormat::kNative) notices.clear();
  const bool is_damaged = !in.damage().empty();
  if (!is_damaged) notices.insert(notices.begin(), in.info().warnings.begin(), in.info().warnings.end());
  for (const std::string& notice : notices) warn(notice);
  if (is_damaged && !arguments.accept_damaged) {
    throw UserError(fmt::format("{}; --accept-damaged converts what is left", in.damage()));
  }

  OutputFile file(arguments.out);
  RecordingWriter out(file, in.info(), machine.configuration);
  Progress progress("convert", in.frame_count(), arguments.progress == "auto");
  const std::uint64_t left_out = copy(in, out, progress);
  out.finish();
  file.commit();
  if (left_out > 0) warn(fmt::format("{}: {} repeated or old frames were left out", arguments.out, left_out));
}

}  // namespace

void add_convert(CLI::App& program) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command =
      program.add_subcommand("convert", "convert a recording between formats, by file ending");
  add_examples(*command, kConvertWords, kConvertExamples);
  command->add_option("in", arguments->in, "recording, .csv, .mrec, .mat or .mcap")->required();
  command
      ->add_option("out", arguments->out,
                   "recording to write, .csv, .mrec, .mat or .mcap; '-': CSV on standard output")
      ->required();
  command
      ->add_option(
          "--map", arguments->map,
          "COLUMN=VARIABLE or COLUMN=FACTOR*VARIABLE: a variable of a .mat file that has another name "
          "than the column; FACTOR is a number or a scalar variable; repeatable")
      ->expected(1)
      ->take_all();
  command->add_option("--rate", arguments->rate_hz, "samples per second of a .mat file without a time")
      ->check(between(0.001, 1.0e6, "Hz"));
  command->add_option("--machine", arguments->machine, "machine that a native recording shall hold");
  command->add_flag("--accept-damaged", arguments->accept_damaged,
                    "convert what is left of a damaged recording");
  add_progress_option(*command, arguments->progress);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
