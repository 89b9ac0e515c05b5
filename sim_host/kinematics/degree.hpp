#pragma once
#include <numbers>

namespace morepro::host {

inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace morepro::host
