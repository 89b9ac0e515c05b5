#pragma once

namespace morepro::host {

/// Whether what is written to this file descriptor is seen on a terminal that knows more than lines (TERM is
/// not 'dumb').
bool is_terminal(int descriptor);

/// The same, and nobody asked for NO_COLOR (no-color.org: set, and not empty).
bool wants_colour(int descriptor);

}  // namespace morepro::host
