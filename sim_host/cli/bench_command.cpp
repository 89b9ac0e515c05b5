#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim_host/bench/timing.hpp"
#include "sim_host/bench/units.hpp"
#include "sim_host/cli/command.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {
namespace {

constexpr const char* kBenchWords =
    "Instructions, flash, RAM and stack of a board: python3 tests/budget/board_table.py";

constexpr const char* kBenchExamples =
    "  morepro bench --seconds 0.05\n"
    "  morepro bench --seconds 0.05 --json bench.json";

struct BenchArguments {
  double seconds = 0.3;
  std::string json;
};

struct Measured {
  BenchUnit unit;
  Timing timing;
};

nlohmann::ordered_json json_of(const std::vector<Measured>& all) {
  nlohmann::ordered_json units = nlohmann::ordered_json::array();
  for (const Measured& one : all)
    units.push_back({{"name", one.unit.name},
                     {"least_ns", one.timing.least_ns},
                     {"median_ns", one.timing.median_ns},
                     {"bytes", one.unit.bytes}});
  return {{"schema", "morepro.bench/1"}, {"units", units}};
}

std::string table_of(const std::vector<Measured>& all) {
  std::string text = fmt::format("{:20} {:>10} {:>10} {:>8}  {}\n", "unit", "least ns", "median ns", "bytes",
                                 "what one call is");
  for (const Measured& one : all)
    text += fmt::format("{:20} {:>10.1f} {:>10.1f} {:>8}  {}\n", one.unit.name, one.timing.least_ns,
                        one.timing.median_ns, one.unit.bytes, one.unit.what);
  return text +
         fmt::format("one core, float, reference machine at 10 kHz; the monitor takes {:.2f} % of it\n",
                     all.front().timing.median_ns / 1.0e3);
}

void run(const BenchArguments& arguments) {
  OutputFile table("-");
  auto json = open_if_asked(arguments.json);
  std::vector<BenchUnit> units = bench_units();
  std::vector<Measured> all;
  for (BenchUnit& unit : units) {
    const Timing timing = timing_of(unit.run, arguments.seconds);
    all.push_back({std::move(unit), timing});
  }
  if (arguments.json != "-") table.write(table_of(all));
  if (json) {
    json->write(json_of(all).dump(2) + "\n");
    json->commit();
  }
  table.commit();
}

}  // namespace

void add_bench(CLI::App& program) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command =
      program.add_subcommand("bench", "time and memory of each part of the monitor on this machine");
  add_examples(*command, kBenchWords, kBenchExamples);
  command->add_option("--seconds", arguments->seconds, "for each unit")
      ->check(between(0.01, 60.0, "s"))
      ->capture_default_str();
  command->add_option("--json", arguments->json, "result as JSON; '-': standard output");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
