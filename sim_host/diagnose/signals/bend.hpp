#pragma once
#include <cstddef>
#include <limits>
#include <vector>

namespace morepro::host {

/// How far a sample is from the line through its neighbours; NaN where one of the three is missing.
inline double bend(const std::vector<float>& column, std::size_t row) {
  if (row == 0 || row + 1 >= column.size()) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(column[row]) -
         0.5 * (static_cast<double>(column[row - 1]) + static_cast<double>(column[row + 1]));
}

/// Standard deviation of a bend of white noise of deviation 1: sqrt(1 + 1/4 + 1/4).
inline constexpr double kBendDeviation = 1.224745;

}  // namespace morepro::host
