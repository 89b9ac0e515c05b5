#pragma once
#include <toml++/toml.h>

#include <string>

namespace morepro::host {

/// A TOML file as a tree. Throws UserError with line and column where it cannot be read or is none.
toml::table parsed_toml(const std::string& path);

}  // namespace morepro::host
