#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/support/printable.hpp"
#include "sim_host/support/user_error.hpp"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int report(int status, const char* sentence) {
  fmt::print(stderr, "morepro: {}\n", morepro::host::printable(sentence));
  return status;
}

/// What was typed, 'help COMMAND' as 'COMMAND --help'.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.resize(std::min(words.size(), std::size_t{1}));
  words.emplace_back("--help");
  return words;
}

int run(int argc, char** argv) {
  morepro::host::keep_command_line(argc, argv);
  CLI::App program{"Tool wear and machine health from sensor recordings: the monitor of the board, on a PC.",
                   "morepro"};
  program.footer("'morepro help COMMAND': its options, and examples to try.");
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
  std::vector<std::string> words = words_of(argc, argv);
  const std::string sentence = morepro::host::unknown_command(program, words.empty() ? "-" : words.front());
  if (!sentence.empty()) return report(kWrongUsage, sentence.c_str());
  try {
    std::reverse(words.begin(), words.end());  // as the parser wants them
    program.parse(words);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return report(kWrongUsage, morepro::host::usage_sentence(program, error).c_str());
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
