#include "sim_host/cli/command.hpp"

#include <fmt/format.h>

#include <string_view>

namespace morepro::host {

CLI::Validator between(double lowest, double highest, const std::string& unit) {
  const std::string range = fmt::format("{} .. {}{}{}", lowest, highest, unit.empty() ? "" : " ", unit);
  return CLI::Validator(
      [lowest, highest, range](std::string& text) -> std::string {
        double value = 0.0;
        const bool is_inside = CLI::detail::lexical_cast(text, value) && value >= lowest && value <= highest;
        return is_inside ? std::string{} : fmt::format("{} is not a number in {}", text, range);
      },
      range);
}

void add_progress_option(CLI::App& command, std::string& mode) {
  command.add_option("--progress", mode, "show how far a long job is, on stderr")
      ->check(CLI::IsMember({"auto", "off"}))
      ->capture_default_str();
}

void warn(std::string_view sentence) { fmt::print(stderr, "morepro: warning: {}\n", sentence); }

}  // namespace morepro::host
