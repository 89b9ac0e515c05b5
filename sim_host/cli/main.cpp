#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int report(int status, const char* sentence) {
  fmt::print(stderr, "morepro: {}\n", sentence);
  return status;
}

/// The sentence for a first word that is no command; empty where it is one, or an option.
std::string unknown_command(const CLI::App& program, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  if (word.starts_with('-') || std::find(known.begin(), known.end(), word) != known.end()) return {};
  const std::string_view near = morepro::host::nearest(word, known);
  const std::string meant =
      near.empty() ? fmt::format("one of {}", fmt::join(known, ", ")) : fmt::format("'{}'", near);
  return fmt::format("unknown command '{}'; did you mean {}?", word, meant);
}

int run(int argc, char** argv) {
  morepro::host::keep_command_line(argc, argv);
  CLI::App program{"Tool wear and machine health from sensor recordings: the monitor of the board, on a PC.",
                   "morepro"};
  program.require_subcommand(1);
  program.set_version_flag("--version", MOREPRO_VERSION);
  morepro::host::add_simulate(program);
  morepro::host::add_replay(program);
  morepro::host::add_identify(program);
  morepro::host::add_convert(program);
  morepro::host::add_diff(program);
  morepro::host::add_config(program);
  morepro::host::add_diagnose(program);
  morepro::host::add_effects(program);
  morepro::host::add_kinematics(program);
  morepro::host::add_thesis(program);
  morepro::host::add_bench(program);
  morepro::host::add_completion(program);
  const std::string_view word = argc > 1 ? argv[1] : "-";
  if (word == "help") {
    fmt::print("{}", program.help());
    return kDone;
  }
  if (const std::string sentence = unknown_command(program, word); !sentence.empty())
    return report(kWrongUsage, sentence.c_str());
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return report(kWrongUsage, fmt::format("{}; see --help", error.what()).c_str());
  }
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const morepro::host::UsageError& error) {
    return report(kWrongUsage, error.what());
  } catch (const std::bad_alloc&) {
    return report(kFailed, "this machine has not enough memory for the job; use a shorter recording");
  } catch (const std::exception& error) {
    return report(kFailed, error.what());
  }
}
