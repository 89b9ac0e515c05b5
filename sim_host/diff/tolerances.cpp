#include "sim_host/diff/tolerances.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

double number_of(std::string_view text, const std::string& option) {
  double value = 0.0;
  const auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = result.ec == std::errc{} && result.ptr == text.data() + text.size();
  if (is_whole && value >= 0.0 && std::isfinite(value)) return value;
  throw UsageError(
      fmt::format("--tol {}: '{}' is no tolerance; write SIGNAL=ABSOLUTE or SIGNAL=ABSOLUTE,RELATIVE with "
                  "numbers from 0 on",
                  option, text));
}

}  // namespace

Tolerance Tolerances::of(std::string_view signal) const {
  const auto own = of_signal.find(signal);
  return own == of_signal.end() ? common : own->second;
}

double allowed_difference(double a, const Tolerance& tolerance) {
  return std::max(tolerance.absolute, tolerance.relative * std::fabs(a));
}

bool is_within(double a, double b, const Tolerance& tolerance) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return true;
  return std::isfinite(a) && std::isfinite(b) && std::fabs(b - a) <= allowed_difference(a, tolerance);
}

void take_tolerance(const std::string& text, Tolerances& tolerances) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(fmt::format("--tol {}: write SIGNAL=ABSOLUTE or SIGNAL=ABSOLUTE,RELATIVE", text));
  const std::string_view values = std::string_view(text).substr(equals + 1);
  const std::size_t comma = values.find(',');
  Tolerance tolerance{.absolute = number_of(values.substr(0, comma), text)};
  if (comma != std::string_view::npos) tolerance.relative = number_of(values.substr(comma + 1), text);
  tolerances.of_signal[text.substr(0, equals)] = tolerance;
}

void check_names(const Tolerances& tolerances, const std::vector<SignalDiff>& signals) {
  std::vector<std::string_view> names;
  for (const SignalDiff& signal : signals) names.push_back(signal.name);
  for (const auto& [name, tolerance] : tolerances.of_signal) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw UsageError(
        fmt::format("--tol {}: neither side has that signal{}", name, did_you_mean(name, names)));
  }
}

}  // namespace morepro::host
