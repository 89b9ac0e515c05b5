#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim_host/diff/diff_output.hpp"

namespace morepro::host {
namespace {

constexpr std::array<const char*, 5> kVerdictWords{"within", "OUT", "MISSING", "ONLY IN A", "ONLY IN B"};

std::string tolerance_text(const Tolerance& tolerance) {
  if (tolerance.relative == 0.0) return fmt::format("{:g}", tolerance.absolute);
  return fmt::format("{:g} or {:g} %", tolerance.absolute, 100.0 * tolerance.relative);
}

std::string number_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.6f}", *value) : std::string("-");
}

std::string counts(const SignalDiff& signal) {
  std::string text = fmt::format("{} of {}", signal.out, signal.compared);
  if (signal.missing_in_a > 0) text += fmt::format(", {} missing in A", signal.missing_in_a);
  if (signal.missing_in_b > 0) text += fmt::format(", {} missing in B", signal.missing_in_b);
  return text;
}

std::string signal_line(const SignalDiff& s, std::size_t width) {
  const char* verdict = kVerdictWords[static_cast<std::size_t>(s.verdict)];
  if (s.verdict == SignalVerdict::kOnlyInA || s.verdict == SignalVerdict::kOnlyInB)
    return fmt::format("  {:<{}}  {}\n", s.name, width, verdict);
  const std::string largest = s.largest ? fmt::format("{:.6g}", s.largest->difference) : std::string("-");
  return fmt::format("  {:<{}}  {:<9}  {:>12}  {:>12}  {:>14}  {}\n", s.name, width, verdict,
                     number_or_dash(s.first_out_s), largest, tolerance_text(s.tolerance), counts(s));
}

std::string value_line(const SignalDiff& s, std::size_t width) {
  if (!s.largest)
    return fmt::format("  {:<{}}  {} -> {}\n", s.name, width, s.text_a.empty() ? "(none)" : s.text_a,
                       s.text_b.empty() ? "(none)" : s.text_b);
  return fmt::format("  {:<{}}  {:.9g} -> {:.9g}, difference {:.6g}, tolerance {}\n", s.name, width,
                     s.largest->a, s.largest->b, s.largest->difference, tolerance_text(s.tolerance));
}

std::size_t width_of(const DiffResult& result) {
  std::size_t width = 0;
  for (const SignalDiff& signal : result.signals) width = std::max(width, signal.name.size());
  return width;
}

std::string recordings_text(const DiffResult& r) {
  std::string text;
  for (const auto& [name, side] : {std::pair("A", r.a), std::pair("B", r.b)})
    text += fmt::format("{}           {}: {} rows at {:g} Hz\n", name, side.file, side.rows, side.rate_hz);
  text += fmt::format("aligned     {} rows within {:g} s; {} only in A, {} only in B\n", r.aligned_rows,
                      r.time_tolerance_s, r.rows_only_in_a, r.rows_only_in_b);
  const std::size_t width = width_of(r);
  text += fmt::format("  {:<{}}  {:<9}  {:>12}  {:>12}  {:>14}  {}\n", "signal", width, "verdict",
                      "first out, s", "largest, B-A", "tolerance", "samples out");
  for (const SignalDiff& signal : r.signals) text += signal_line(signal, width);
  return text;
}

std::string results_text(const DiffResult& r) {
  std::string text = fmt::format("A           {}\nB           {}\n", r.a.file, r.b.file);
  const std::size_t width = width_of(r);
  for (const SignalDiff& signal : r.signals)
    if (signal.verdict != SignalVerdict::kWithin) text += value_line(signal, width);
  return text;
}

/// "3 of 12 signals are out of tolerance, first feed_force_n at 1.2 s"; empty where none is.
std::string signals_out(const DiffResult& r) {
  const SignalDiff* first = nullptr;
  std::size_t out = 0;
  for (const SignalDiff& s : r.signals) {
    if (s.verdict == SignalVerdict::kWithin) continue;
    ++out;
    const bool is_earlier =
        first != nullptr && s.first_out_s && (!first->first_out_s || *s.first_out_s < *first->first_out_s);
    if (first == nullptr || is_earlier) first = &s;
  }
  if (first == nullptr) return {};
  const std::string at = first->first_out_s ? fmt::format(" at {:g} s", *first->first_out_s) : std::string();
  return fmt::format("{} of {} {} are out of tolerance, first {}{}", out, r.signals.size(),
                     r.is_of_recordings ? "signals" : "values", first->name, at);
}

}  // namespace

std::string diff_sentence(const DiffResult& r) {
  if (r.is_within()) return {};
  if (r.is_of_recordings && r.aligned_rows == 0)
    return fmt::format(
        "no row has a partner within {:g} s; give a larger --time-tol, or recordings of the same time",
        r.time_tolerance_s);
  std::vector<std::string> reasons;
  if (const std::string signals = signals_out(r); !signals.empty()) reasons.push_back(signals);
  if (r.rows_only_in_a > 0) reasons.push_back(fmt::format("{} row(s) are only in A", r.rows_only_in_a));
  if (r.rows_only_in_b > 0) reasons.push_back(fmt::format("{} row(s) are only in B", r.rows_only_in_b));
  return fmt::format("{}", fmt::join(reasons, "; "));
}

std::string diff_text(const DiffResult& r) {
  const std::string why = diff_sentence(r);
  return (r.is_of_recordings ? recordings_text(r) : results_text(r)) +
         fmt::format("verdict     {}\n", why.empty() ? "the same within tolerance" : why);
}

}  // namespace morepro::host
