#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim_host/diff/diff_result.hpp"

namespace morepro::host {

/// What may differ, and by how much.
struct Tolerances {
  Tolerance common;
  std::map<std::string, Tolerance, std::less<>> of_signal;
  double time_s = 0.0;

  [[nodiscard]] Tolerance of(std::string_view signal) const;
};

/// How far from the baseline `a` a value may be.
double allowed_difference(double a, const Tolerance& tolerance);

/// Is `b` within tolerance of the baseline `a`? Two NaN, and two infinities of one sign, are.
bool is_within(double a, double b, const Tolerance& tolerance);

/// Reads "feed_force_n=0.5" or "feed_force_n=0.5,0.01" (absolute, relative) into `of_signal`. Throws
/// UsageError.
void take_tolerance(const std::string& text, Tolerances& tolerances);

/// Throws UsageError where a signal with a tolerance of its own is not among `names`.
void check_names(const Tolerances& tolerances, const std::vector<SignalDiff>& signals);

}  // namespace morepro::host
