#pragma once
#include <numbers>

namespace morepro::host {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace morepro::host
