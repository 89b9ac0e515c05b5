#include "sim_host/replay/result_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lib/monitor/reason.hpp"
#include "sim_host/replay/gap_report.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

constexpr std::uint64_t kMostChangesShown = 12;
constexpr double kShortestShownS = 0.02;

std::string line(std::string_view title, std::string_view content) {
  return fmt::format("{:<12}{}\n", title, content);
}

std::string recording_lines(const ReplayResult& r) {
  std::string text = line("Recording", fmt::format("{}: {} rows, {:.4f} s at {:g} Hz", r.info.file,
                                                   r.tally.rows, r.tally.duration_s, r.info.rate_hz));
  if (r.tally.gaps > 0) {
    text += line("", fmt::format("{} missing rows in {} gap(s), the first behind {:.4f} s",
                                 r.tally.missing_rows, r.tally.gaps, r.tally.first_gap_s));
  }
  if (!r.damage.empty()) text += line("", fmt::format("DAMAGED: {}", r.damage));
  return text + line("Machine", r.machine_name);
}

std::string frame_lines(const ReplayResult& r) {
  std::string text =
      line("Frames", fmt::format("{} accepted, {} rejected, {} missing", r.last.frames_accepted,
                                 r.last.frames_rejected, r.last.frames_missing));
  for (const auto& [name, count] : r.reasons) text += line("", fmt::format("{}: {}", name, count));
  return text;
}

std::string probability_text(const ReplayResult& r) {
  const std::string_view rule = name_of(r.configuration.rule);
  if (!r.has_probability()) return fmt::format(" (rule '{}' has no probabilities", rule);
  return fmt::format(", probability {:.4f} (rule '{}'", r.judged.selected_probability, rule);
}

std::string chip_load_lines(const ReplayResult& r) {
  if (!r.has_chip_load()) return line("Chip load", "undetermined") + line("Hypothesis", "none selected");
  std::string commanded;
  if (r.commanded_chip_load_mm > 0.0F)
    commanded = fmt::format(", commanded {:.4g} mm", r.commanded_chip_load_mm);
  const auto selected = r.judged.selected_hypothesis;
  return line("Chip load",
              fmt::format("{:.5f} mm, standard error {:.5f} mm (at {:.4f} s{})", r.judged.chip_load_mm,
                          r.judged.chip_load_standard_error_mm, r.judged_time_s, commanded)) +
         line("Hypothesis",
              fmt::format("{:.4g} mm{}, {} hypotheses {:.4g} .. {:.4g} mm)", r.hypotheses_mm.at(selected),
                          probability_text(r), r.hypotheses_mm.size(), r.hypotheses_mm.front(),
                          r.hypotheses_mm.back()));
}

std::string timeline_line(const ReplayResult& r, const TimelineEntry& entry) {
  std::string text = fmt::format("{:9.4f} s  {}", entry.time_s, name_of(entry.state));
  if (entry.chip_load_state == ChipLoadState::kValid) {
    return fmt::format("{}, {:.4g} mm", text, r.hypotheses_mm.at(entry.selected_hypothesis));
  }
  return fmt::format("{}, {}", text, text_of(static_cast<ReasonCode>(entry.reason)).name);
}

// Decisions that are taken back within a few samples would hide the ones that last.
bool is_shown(const ReplayResult& r, std::size_t index) {
  return index + 1 == r.timeline.size() ||
         r.timeline[index + 1].time_s - r.timeline[index].time_s >= kShortestShownS;
}

std::string timeline_lines(const ReplayResult& r) {
  std::string text;
  std::uint64_t shown = 0;
  for (std::size_t i = 0; i < r.timeline.size() && shown < kMostChangesShown; ++i) {
    if (!is_shown(r, i)) continue;
    text += line(shown++ == 0 ? "Over time" : "", timeline_line(r, r.timeline[i]));
  }
  if (r.timeline_changes > shown) {
    text +=
        line("", fmt::format("and {} more changes, the short ones among them; --out FILE.csv has every frame",
                             r.timeline_changes - shown));
  }
  return text;
}

std::string parameter_text(const ReplayResult& r, Parameter parameter) {
  const ParameterEstimate& estimate = r.last.parameters[index_of(parameter)];
  if (!is_described(r, parameter)) return "not described";
  const std::string datasheet =
      fmt::format("datasheet {:<9.5g}", datasheet_value(r.configuration.machine, parameter));
  if (estimate.status != ParameterStatus::kIdentifiable) {
    return fmt::format("{} not identified: {}", datasheet, reason_of(r, parameter));
  }
  const std::string assumption = reason_of(r, parameter);
  return fmt::format("{} estimate {:.5g}, standard error {:.2g}{}{}", datasheet, estimate.value,
                     estimate.standard_error, assumption.empty() ? "" : "; ", assumption);
}

std::string parameter_lines(const ReplayResult& r) {
  std::string text;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const auto parameter = static_cast<Parameter>(i);
    text += line(i == 0 ? "Parameters" : "",
                 fmt::format("{:<25}{}", name_of(parameter), parameter_text(r, parameter)));
  }
  return text;
}

std::string part_lines(const ReplayResult& r) {
  std::string text;
  for (const EvaluatedPart& part : r.parts) {
    const std::string content =
        part.is_evaluated
            ? fmt::format("{}: evaluated{}{}", part.name, part.reason.empty() ? "" : "; ", part.reason)
            : fmt::format("{}: not evaluated ({})", part.name, part.reason);
    text += line(text.empty() ? "Evaluation" : "", content);
  }
  return text;
}

std::string coloured(HealthState state, bool with_colour) {
  if (!with_colour) return std::string(name_of(state));
  const bool is_good = state == HealthState::kHealthy;
  const bool is_open = state == HealthState::kNotEnoughData;
  return fmt::format("\033[1;{}m{}\033[0m", is_good ? 32 : is_open ? 33 : 31, name_of(state));
}

std::string health_lines(const ReplayResult& r, bool with_colour) {
  const Health health = verdict_of(r);
  const ReasonText reason = verdict_reason(r);
  std::string text = line(
      "Health", fmt::format("{}  {}: {}", coloured(health.state, with_colour), reason.name, reason.sentence));
  if (!reason.cause.empty()) text += line("", fmt::format("Likely cause: {}", reason.cause));
  if (!reason.next_step.empty()) text += line("", fmt::format("Next step: {}", reason.next_step));
  return text;
}

}  // namespace

std::string result_text(const ReplayResult& result, bool with_colour) {
  const double real_time = result.elapsed_s > 0.0 ? result.tally.duration_s / result.elapsed_s : 0.0;
  return recording_lines(result) + frame_lines(result) + chip_load_lines(result) + timeline_lines(result) +
         parameter_lines(result) + part_lines(result) + line("Gap", gap_text(result.last.gap)) +
         health_lines(result, with_colour) +
         line("Replay",
              fmt::format("{:.0f} frames/s, {:.0f} times real time", result.frames_per_s(), real_time));
}

}  // namespace morepro::host
