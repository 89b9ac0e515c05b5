#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

#include "lib/frame/channel.hpp"
#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/cli/command.hpp"

namespace morepro::host {
namespace {

constexpr const char* kCompletionWords =
    "For every shell that is opened: the line below in ~/.bashrc; for zsh with 'zsh' in ~/.zshrc.";

constexpr const char* kCompletionExamples = "  source <(morepro completion bash)";

std::string effect_names() {
  std::vector<std::string_view> names;
  for (const gap::EffectInfo& info : gap::kEffects) names.push_back(gap::name_of(info.effect));
  return fmt::format("{}", fmt::join(names, " "));
}

/// "a b" of "TEXT:{a,b}", which CLI11 makes of a closed set; empty for any other value.
std::string closed_set(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::string words = type.substr(begin + 1, end - begin - 1);
  for (char& c : words)
    if (c == ',') c = ' ';
  return words;
}

std::string column_names() {
  std::vector<std::string_view> names;
  for (const ChannelInfo& info : kChannels) names.push_back(info.column);
  return fmt::format("{}", fmt::join(names, " "));
}

/// What may follow an option; empty: a file, or anything.
std::string values_of(const CLI::Option& option) {
  const std::string name = option.get_lnames().empty() ? "" : option.get_lnames().front();
  if (name == "tol") return column_names();
  if (name == "map") return "time_s " + column_names();
  if (name == "effect" || name == "exclude") return effect_names();
  if (name == "machine") return "reference thesis";
  return closed_set(option);
}

/// What the first word of a command may be; empty: a file, or anything.
std::string first_words_of(const CLI::App& command) {
  if (command.get_name() == "effects") return effect_names();
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) return closed_set(*option);
  return {};
}

std::string case_of(const CLI::App& command) {
  std::string words, values;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) {
      words += " --" + name;
      if (const std::string known = values_of(*option); !known.empty())
        values += fmt::format("        --{}) words=\"{}\" ;;\n", name, known);
    }
  if (const std::string known = first_words_of(command); !known.empty())
    values += fmt::format("        {}) case \"$word\" in -*) ;; *) words=\"{}\" ;; esac ;;\n",
                          command.get_name(), known);
  std::string text = fmt::format("    {})\n      words=\"{}\"\n", command.get_name(),
                                 words.empty() ? words : words.substr(1));
  if (!values.empty()) text += fmt::format("      case \"$before\" in\n{}      esac\n", values);
  return text + "      ;;\n";
}

std::string script_of(const CLI::App& program) {
  std::string cases;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
    cases += case_of(*command);
  }
  // Where nothing fits, files are offered: most arguments are files.
  return fmt::format(
      "_morepro() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" before=\"${{COMP_WORDS[COMP_CWORD-1]}}\" words=\"\"\n"
      "  case \"$COMP_CWORD ${{COMP_WORDS[1]}}\" in\n"
      "    1\\ *) COMPREPLY=($(compgen -W \"{0} help --help --version\" -- \"$word\")); return ;;\n"
      "  esac\n"
      "  case \"${{COMP_WORDS[1]}}\" in\n"
      "    help) words=\"{0}\" ;;\n"
      "{1}"
      "  esac\n"
      "  COMPREPLY=()\n"
      "  case \"$word $words\" in\n"
      "    -*|*\\ [!-]*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o default -F _morepro morepro\n",
      fmt::join(names, " "), cases);
}

}  // namespace

void add_completion(CLI::App& program) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "completion", "print a script that completes commands, options and names in a shell");
  add_examples(*command, kCompletionWords, kCompletionExamples);
  command->add_option("shell", *shell, "bash or zsh")->required()->check(one_of({"bash", "zsh"}));
  command->callback([shell, &program] {
    if (*shell == "zsh")
      fmt::print("autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n");
    fmt::print("{}", script_of(program));
  });
}

}  // namespace morepro::host
