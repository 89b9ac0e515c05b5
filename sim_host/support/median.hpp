#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace morepro::host {

/// Standard deviations of normal noise per median of its absolute value.
inline constexpr double kDeviationPerMedian = 1.4826;

/// The upper one of an even number of values. `values`: at least one, no NaN; they are left in another order.
inline double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace morepro::host
