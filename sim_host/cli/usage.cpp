#include "sim_host/cli/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

std::vector<std::string_view> views_of(const std::vector<std::string>& words) {
  return {words.begin(), words.end()};
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The command that was being parsed, or the program itself.
const CLI::App& parsed(const CLI::App& program) {
  const auto commands = program.get_subcommands();
  return commands.empty() ? program : *commands.front();
}

/// What nobody knows: an option before a word, because the word may be its value.
std::string unexpected(const CLI::App& program) {
  const std::vector<std::string> rest = program.remaining(true);
  const auto option =
      std::find_if(rest.begin(), rest.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (option == rest.end()) return fmt::format("'{}' is not expected", rest.empty() ? "" : rest.front());
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("option '{}' is not known{}", name,
                     did_you_mean(name, views_of(option_names(parsed(program)))));
}

/// "--x" of the parser's "--x: 1 required TEXT missing" and the like.
std::string_view before(std::string_view text, std::string_view mark) {
  return text.substr(0, text.find(mark));
}

std::string reason(const CLI::App& program, const CLI::ParseError& error) {
  constexpr std::string_view kNotConverted = "Could not convert: ";
  const std::string_view text = error.what();
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  if (code == CLI::ExitCodes::ExtrasError) return unexpected(program);
  if (code == CLI::ExitCodes::ArgumentMismatch && text.ends_with("missing"))
    return fmt::format("{}: its value is missing", before(text, ":"));
  if (code == CLI::ExitCodes::ConversionError && text.starts_with(kNotConverted)) {
    const std::string_view pair = text.substr(kNotConverted.size());
    const std::string_view option = before(pair, " = ");
    return fmt::format("{}: '{}' is not understood; write numbers", option, pair.substr(option.size() + 3));
  }
  return std::string(text);
}

}  // namespace

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::Validator(
      [words](std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        return fmt::format("'{}' is none of {}{}", text, fmt::join(words, ", "),
                           did_you_mean(text, views_of(words)));
      },
      fmt::format("{{{}}}", fmt::join(words, ",")));
}

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

CLI::Validator whole_number() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_whole = error == std::errc{} && end == text.data() + text.size();
        return is_whole ? std::string{}
                        : fmt::format("'{}' is no whole number from 0 to {}", text, UINT64_MAX);
      },
      "");
}

std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = parsed(program);
  if (&command != &program)
    return fmt::format("{}; see morepro {} --help", reason(program, error), command.get_name());
  if (!program.remaining(true).empty()) return unexpected(program) + "; see morepro --help";
  return fmt::format("a command is missing; one of {}", fmt::join(command_names(program), ", "));
}

std::string unknown_command(const CLI::App& program, std::string_view word) {
  const std::vector<std::string> names = command_names(program);
  if (word.starts_with('-') || std::find(names.begin(), names.end(), word) != names.end()) return {};
  const std::string_view near = nearest(word, views_of(names));
  const std::string meant =
      near.empty() ? fmt::format("one of {}", fmt::join(names, ", ")) : fmt::format("'{}'", near);
  return fmt::format("unknown command '{}'; did you mean {}?", word, meant);
}

}  // namespace morepro::host
