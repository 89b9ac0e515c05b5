#include "sim_host/cli/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sim_host/support/printable.hpp"

namespace morepro::host {

void add_progress_option(CLI::App& command, std::string& mode) {
  command.add_option("--progress", mode, "show how far a long job is, on stderr")
      ->check(one_of({"auto", "off"}))
      ->capture_default_str();
}

void add_report_option(CLI::App& command, std::string& file) {
  command.add_option("--report", file, "page with the result and its evidence (HTML, one file, no network)");
}

void add_text_option(CLI::App& command, std::string& file) {
  command.add_option("--out", file, "write what is printed to a file; '-': on standard output");
}

void show_text(OutputFile* out, std::initializer_list<std::string_view> others, std::string_view text) {
  if (out != nullptr) {
    out->write(text);
    out->commit();
  } else if (std::ranges::find(others, "-") == others.end()) {
    fmt::print("{}", text);
  }
}

void add_examples(CLI::App& command, std::string_view words, std::string_view examples) {
  command.footer(fmt::format("{}{}Examples:\n{}", words, words.empty() ? "" : "\n\n", examples));
}

namespace {

std::string& kept_line() {
  static std::string line;
  return line;
}

std::string quoted(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

void keep_command_line(int count, const char* const* words) {
  std::string& line = kept_line();
  line = "morepro";
  for (int i = 1; i < count; ++i) line += " " + quoted(words[i]);
}

const std::string& command_line() { return kept_line(); }

void warn(std::string_view sentence) { fmt::print(stderr, "morepro: warning: {}\n", printable(sentence)); }

}  // namespace morepro::host
