#include <fmt/format.h>

#include <memory>
#include <string>

#include "sim_host/cli/command.hpp"
#include "sim_host/page/page.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/output_file.hpp"
#include "sim_host/support/progress.hpp"
#include "sim_host/support/user_error.hpp"
#include "sim_host/thesis/thesis_report.hpp"

namespace morepro::host {
namespace {

constexpr const char* kThesisExamples =
    "  morepro thesis\n"
    "  morepro thesis --report thesis.html\n"
    "  morepro thesis --bank --runs 1 --json thesis.json";

struct ThesisArguments {
  std::string report;
  std::string json;
  bool with_bank = false;
  int runs = 20;
  std::uint64_t seed = 1;
  std::string progress = "auto";
};

std::vector<thesis::BankTrialRow> bank_of(const ThesisArguments& arguments) {
  if (!arguments.with_bank) return {};
  StageProgress progress("thesis", arguments.progress != "off");
  return thesis::run_bank_trial(
      {.runs = arguments.runs,
       .seed = arguments.seed,
       .on_progress = [&](std::string_view stage, double share) { progress.show(stage, share); }});
}

void run(const ThesisArguments& arguments) {
  check_distinct({}, {{"--report", arguments.report}, {"--json", arguments.json}});
  if (const std::string why = why_no_page(k_thesis_page); !arguments.report.empty() && !why.empty())
    throw UserError(why);
  const auto report = open_if_asked(arguments.report);
  const auto json = open_if_asked(arguments.json);
  const auto figures = thesis::all_figures();
  const auto bank = bank_of(arguments);
  if (report) report->write(thesis::thesis_page(figures, bank));
  if (json) json->write(thesis::thesis_json(figures, bank));
  if (!report && arguments.json != "-") {
    fmt::print("{}", thesis::figures_text(figures));
    if (!bank.empty()) fmt::print("\n{}", thesis::bank_text(bank, arguments.runs));
  }
  if (report) report->commit();
  if (json) json->commit();
}

}  // namespace

void add_thesis(CLI::App& program) {
  auto arguments = std::make_shared<ThesisArguments>();
  CLI::App* command = program.add_subcommand("thesis",
                                             "recompute the thesis's figures: what it prints beside what "
                                             "this library computes, and why they differ");
  command->add_option("--report", arguments->report,
                      "page with every figure (HTML, one file, no network) instead of the table");
  command->add_option("--json", arguments->json,
                      "write printed and computed values as JSON; '-': standard output");
  CLI::Option* bank = command->add_flag(
      "--bank", arguments->with_bank,
      "also the filter bank of section 4.4: the thesis's rule beside the others, over noise "
      "and wrong datasheets");
  command->add_option("--runs", arguments->runs, "runs per condition of --bank")
      ->check(between(1, 10000, ""))
      ->needs(bank)
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "of the runs of --bank")
      ->check(whole_number())
      ->needs(bank)
      ->capture_default_str();
  add_progress_option(*command, arguments->progress);
  add_examples(*command, "", kThesisExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
