#pragma once
#include <string>
#include <string_view>

struct matvar_t;

namespace morepro::host {

/// A row of characters as UTF-8; empty where the variable is none.
std::string mat_text(const matvar_t* variable);

/// A row of characters, which MATLAB keeps as UTF-16, without a name. Owned by the caller; null where there
/// is no memory.
matvar_t* new_mat_text(std::string_view utf8);

}  // namespace morepro::host
