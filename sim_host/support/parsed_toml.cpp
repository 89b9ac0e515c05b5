#include "sim_host/support/parsed_toml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {

toml::table parsed_toml(const std::string& path) {
  const InputFile file(path);
  try {
    return toml::parse(file.text(), path);
  } catch (const toml::parse_error& error) {
    std::string sentence(error.description());
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    const auto& begin = error.source().begin;
    throw UserError(TextPlace{path, begin.line, begin.column},
                    fmt::format("no valid TOML: {}; correct this place", sentence));
  }
}

}  // namespace morepro::host
