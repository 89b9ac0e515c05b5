#include "sim_host/thesis/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace morepro::host::thesis {
namespace {

bool is_single(const Range& range) { return range.low == range.high; }

std::string rounded(double value) {
  return std::abs(value) < 100.0 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

/// Beyond a factor of three nobody thinks in percent.
std::string ratio_text(double ours, double printed) {
  if (ours == printed) return "none";
  const double ratio = ours / printed;
  if (!(ratio > 0.0 && std::isfinite(ratio))) return fmt::format("{:+.2g}", ours - printed);
  if (ratio > 3.0) return fmt::format("ours {} times the printed", rounded(ratio));
  if (ratio < 1.0 / 3.0) return fmt::format("printed {} times ours", rounded(1.0 / ratio));
  const double percent = 100.0 * (ratio - 1.0);
  return std::abs(percent) < 10.0 ? fmt::format("{:+.2g} %", percent) : fmt::format("{:+.0f} %", percent);
}

std::string inside_text(double ours, const Range& printed) {
  if (ours < printed.low) return fmt::format("{:.2g} below the printed range", printed.low - ours);
  if (ours > printed.high) return fmt::format("{:.2g} above the printed range", ours - printed.high);
  return "inside the printed range";
}

}  // namespace

Range range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

std::string difference_of(const Comparison& comparison) {
  if (!comparison.note.empty()) return comparison.note;
  if (!comparison.printed) return "not printed";
  if (!comparison.ours) return "undetermined";
  const Range printed = *comparison.printed, ours = *comparison.ours;
  if (is_single(ours))
    return is_single(printed) ? ratio_text(ours.low, printed.low) : inside_text(ours.low, printed);
  return fmt::format("{:+.2g} and {:+.2g} at its ends", ours.low - printed.low, ours.high - printed.high);
}

std::vector<Figure> all_figures() {
  std::vector<Figure> figures = kinematic_figures();
  for (auto&& group : {friction_figures(), identification_figures()})
    figures.insert(figures.end(), group.begin(), group.end());
  return figures;
}

}  // namespace morepro::host::thesis
