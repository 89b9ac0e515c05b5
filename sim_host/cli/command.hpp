#pragma once
#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>

#include "sim_host/cli/usage.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Each adds one subcommand with its options to the program; the job runs when the command line is parsed and
/// throws UserError (status 1) or UsageError (status 2).
void add_simulate(CLI::App& program);
void add_replay(CLI::App& program);
void add_convert(CLI::App& program);
void add_config(CLI::App& program);
void add_diff(CLI::App& program);
void add_diagnose(CLI::App& program);
void add_identify(CLI::App& program);
void add_effects(CLI::App& program);
void add_kinematics(CLI::App& program);
void add_thesis(CLI::App& program);
void add_bench(CLI::App& program);
void add_completion(CLI::App& program);

/// --progress auto|off
void add_progress_option(CLI::App& command, std::string& mode);

/// --report FILE.html
void add_report_option(CLI::App& command, std::string& file);

/// --out of a command whose result is a text: the file that takes it instead of standard output.
void add_text_option(CLI::App& command, std::string& file);

/// Puts that text into `out`, or on standard output where no file of `others` goes there.
void show_text(OutputFile* out, std::initializer_list<std::string_view> others, std::string_view text);

/// What stands below the options in --help: words, may be empty, and examples, which work one after the other
/// in an empty folder.
void add_examples(CLI::App& command, std::string_view words, std::string_view examples);

/// What was typed, quoted for a shell, so that it can be typed again: kept by main, shown in reports.
void keep_command_line(int count, const char* const* words);
const std::string& command_line();

/// A sentence on stderr that does not end the job.
void warn(std::string_view sentence);

}  // namespace morepro::host
