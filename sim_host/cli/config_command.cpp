#include <memory>
#include <string>

#include "sim_host/cli/command.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/machine/machine_file_writer.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {
namespace {

constexpr const char* kConfigExamples =
    "  morepro config > machine.toml\n"
    "  morepro config --machine thesis --out thesis.toml\n"
    "  morepro simulate --machine machine.toml --duration 1 --out run.csv";

struct ConfigArguments {
  std::string machine = "reference";
  std::string out = "-";
};

void run(const ConfigArguments& arguments) {
  check_distinct({{"--machine", arguments.machine}}, {{"--out", arguments.out}});
  const MachineDescription machine = load_machine(arguments.machine);
  OutputFile file(arguments.out);
  file.write(config_text(machine));
  file.commit();
}

}  // namespace

void add_config(CLI::App& program) {
  auto arguments = std::make_shared<ConfigArguments>();
  CLI::App* command = program.add_subcommand(
      "config", "print every setting of a machine as TOML, a machine file to start from");
  command->add_option("--machine", arguments->machine, "'reference', 'thesis' or a machine file")
      ->capture_default_str();
  command->add_option("--out", arguments->out, "file to write; '-': standard output")->capture_default_str();
  add_examples(*command, "", kConfigExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
