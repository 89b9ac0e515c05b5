#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim_host/thesis/figure.hpp"

namespace morepro::host::thesis {

/// Chip loads of section 4.3, in mm as the thesis prints them.
inline constexpr Range kPrintedChipLoadMm{0.1, 1.1};

inline Range single(double value) { return {value, value}; }

/// Evenly spaced values of a range, its ends included.
inline std::vector<double> steps(Range range) {
  constexpr int kPoints = 121;
  std::vector<double> values;
  for (int k = 0; k < kPoints; ++k)
    values.push_back(range.low + (range.high - range.low) * k / (kPoints - 1));
  return values;
}

inline Curve curve(std::string label, const std::vector<double>& x, const std::function<double(double)>& f) {
  Curve result{.label = std::move(label), .y = {}};
  for (const double value : x) result.y.push_back(f(value));
  return result;
}

/// Where a falling function takes a value, by bisection.
inline double where(const std::function<double(double)>& f, double value, Range range) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (range.low + range.high);
    (f(middle) > value ? range.low : range.high) = middle;
  }
  return range.low;
}

}  // namespace morepro::host::thesis
