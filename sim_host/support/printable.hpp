#pragma once
#include <string>
#include <string_view>

namespace morepro::host {

/// What can be shown on a terminal: control characters and bytes that are no UTF-8 as \xNN, and of more than
/// 1000 bytes the first and the last ones.
std::string printable(std::string_view text);

}  // namespace morepro::host
