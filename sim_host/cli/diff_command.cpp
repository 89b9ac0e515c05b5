#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/diff/diff_output.hpp"
#include "sim_host/diff/recording_diff.hpp"
#include "sim_host/diff/result_diff.hpp"
#include "sim_host/report/diff_report.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/progress.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr const char* kDiffWords =
    "A is the baseline: a sample of B may differ by the greater of ABSOLUTE and RELATIVE times |A|. "
    "Recordings of\n"
    "any format and rate are compared at the rows of the slower one; files that end in .json are results.\n"
    "Status 0: all within tolerance; 1: not.";

constexpr const char* kDiffExamples =
    "  morepro simulate --duration 1 --out before.csv && morepro convert before.csv after.mat\n"
    "  morepro diff before.csv after.mat --rel-tol 1e-6 --tol feed_force_n=0.5,0.01\n"
    "  morepro diff before.csv after.mat --rel-tol 1e-3 --report differences.html\n"
    "  morepro diff before.csv after.mat --time-tol 0.0005 --out differences.csv\n"
    "  morepro replay before.csv --json before.json && morepro replay after.mat --json after.json\n"
    "  morepro diff before.json after.json --rel-tol 1e-6 --tol chip_load_mm.estimate=0.001";

struct DiffArguments {
  std::string a;
  std::string b;
  double absolute = 0.0;
  double relative = 0.0;
  double time_s = 0.0;
  std::vector<std::string> tolerances;
  std::string json;
  std::string out;
  std::string report;
  std::string progress = "auto";
};

bool is_result(const std::string& path) { return std::filesystem::path(path).extension() == ".json"; }

Tolerances tolerances_of(const DiffArguments& arguments) {
  Tolerances tolerances{
      .common = {arguments.absolute, arguments.relative}, .of_signal = {}, .time_s = arguments.time_s};
  for (const std::string& text : arguments.tolerances) take_tolerance(text, tolerances);
  return tolerances;
}

void warn_about(const RecordingReader& recording) {
  for (const std::string& sentence : recording.info().warnings) warn(sentence);
  if (recording.info().warnings.empty() && !recording.damage().empty()) warn(recording.damage());
}

DiffResult compare_recordings(const DiffArguments& arguments, OutputFile* out, DiffReport* report) {
  RecordingReader a(arguments.a);
  RecordingReader b(arguments.b);
  warn_about(a);
  warn_about(b);
  std::optional<DifferenceCsv> differences;
  if (out != nullptr) differences.emplace(*out, a.info(), b.info());
  const Tolerances tolerances = tolerances_of(arguments);
  if (report != nullptr) report->begin(a.info(), b.info(), tolerances);
  Progress progress("diff", a.frame_count(), arguments.progress == "auto");
  return diff_recordings(a, b, tolerances, [&](const AlignedRow& row) {
    if (differences) differences->write(row);
    if (report != nullptr) report->take(row);
    progress.advance();
  });
}

DiffResult compare(const DiffArguments& arguments, OutputFile* out, DiffReport* report) {
  if (is_result(arguments.a) != is_result(arguments.b))
    throw UsageError(
        fmt::format("{} and {}: give two recordings or two results (.json)", arguments.a, arguments.b));
  if (!is_result(arguments.a)) return compare_recordings(arguments, out, report);
  if (out != nullptr || arguments.time_s != 0.0)
    throw UsageError("--out and --time-tol are for recordings; results have no time");
  return diff_results(arguments.a, arguments.b, tolerances_of(arguments));
}

void run(const DiffArguments& arguments) {
  check_distinct({{"A", arguments.a}, {"B", arguments.b}},
                 {{"--json", arguments.json}, {"--out", arguments.out}, {"--report", arguments.report}});
  std::optional<DiffReport> report;
  if (!arguments.report.empty()) report.emplace();
  const auto json = open_if_asked(arguments.json);
  const auto out = open_if_asked(arguments.out);
  const auto page = open_if_asked(arguments.report);
  const DiffResult result = compare(arguments, out.get(), report ? &*report : nullptr);
  const std::string text = diff_json(result);
  if (json) json->write(text);
  if (page) page->write(report->html(result, text, command_line(), {arguments.a, arguments.b}));
  if (arguments.json != "-" && arguments.out != "-" && arguments.report != "-")
    fmt::print("{}", diff_text(result));
  for (OutputFile* file : {json.get(), out.get(), page.get()})
    if (file != nullptr) file->commit();
  if (!result.is_within())
    throw UserError(fmt::format("{} and {} differ: {}", arguments.a, arguments.b, diff_sentence(result)));
}

}  // namespace

void add_diff(CLI::App& program) {
  auto arguments = std::make_shared<DiffArguments>();
  CLI::App* command = program.add_subcommand(
      "diff", "compare two recordings or two results, signal by signal, within tolerances");
  add_examples(*command, kDiffWords, kDiffExamples);
  command->add_option("A", arguments->a, "baseline: a recording of any format, or a result (.json)")
      ->required();
  command->add_option("B", arguments->b, "what is compared with it")->required();
  const auto tolerance = between(0.0, 1.0e30, "");
  command->add_option("--abs-tol", arguments->absolute, "difference allowed, in the signal's unit")
      ->check(tolerance)
      ->capture_default_str();
  command->add_option("--rel-tol", arguments->relative, "difference allowed, as a share of the baseline")
      ->check(tolerance)
      ->capture_default_str();
  command->add_option("--time-tol", arguments->time_s, "how far apart samples of one row may be, in s")
      ->check(between(0.0, 1000.0, "s"))
      ->capture_default_str();
  command
      ->add_option("--tol", arguments->tolerances,
                   "SIGNAL=ABSOLUTE[,RELATIVE]: a tolerance of its own; repeatable")
      ->expected(1)
      ->take_all();
  command->add_option("--json", arguments->json, "write the comparison as JSON; '-': on standard output");
  command->add_option("--out", arguments->out, "write the differences B - A as CSV, row by row");
  add_report_option(*command, arguments->report);
  add_progress_option(*command, arguments->progress);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
