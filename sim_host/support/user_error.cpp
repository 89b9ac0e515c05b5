#include "sim_host/support/user_error.hpp"

#include <fmt/format.h>

namespace morepro::host {

std::string to_text(const TextPlace& place) {
  if (place.line == 0) return place.file;
  if (place.column == 0) return fmt::format("{}, line {}", place.file, place.line);
  return fmt::format("{}, line {}, column {}", place.file, place.line, place.column);
}

UserError::UserError(const TextPlace& place, std::string_view sentence)
    : std::runtime_error(fmt::format("{}: {}", to_text(place), sentence)) {}

}  // namespace morepro::host
