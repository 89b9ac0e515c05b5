#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace morepro::host {

/// One of `words`, or the nearest one is suggested. Shell completion offers them.
CLI::Validator one_of(const std::vector<std::string>& words);

/// A number in [lowest, highest]; NaN is refused as well.
CLI::Validator between(double lowest, double highest, const std::string& unit);

/// 0 .. 2^64 - 1, as a seed.
CLI::Validator whole_number();

/// The sentence for what the command line's parser refuses.
std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

/// The sentence for a first word that is no command; empty where it is one, or an option.
std::string unknown_command(const CLI::App& program, std::string_view word);

}  // namespace morepro::host
