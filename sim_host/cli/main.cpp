#include <fmt/format.h>

#include <exception>

#include "sim_host/cli/command.hpp"
#include "sim_host/support/user_error.hpp"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int report(int status, const char* sentence) {
  fmt::print(stderr, "morepro: {}\n", sentence);
  return status;
}

int run(int argc, char** argv) {
  CLI::App program{"Tool wear and machine health from sensor recordings: the monitor of the board, on a PC.",
                   "morepro"};
  program.require_subcommand(1);
  program.set_version_flag("--version", MOREPRO_VERSION);
  morepro::host::add_simulate(program);
  morepro::host::add_replay(program);
  morepro::host::add_convert(program);
  morepro::host::add_config(program);
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
