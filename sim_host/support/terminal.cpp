#include "sim_host/support/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace morepro::host {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view(value);
}

}  // namespace

bool is_terminal(int descriptor) { return isatty(descriptor) == 1 && environment("TERM") != "dumb"; }

bool wants_colour(int descriptor) { return is_terminal(descriptor) && environment("NO_COLOR").empty(); }

}  // namespace morepro::host
