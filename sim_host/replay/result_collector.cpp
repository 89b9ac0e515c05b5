#include "sim_host/replay/result_collector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "lib/monitor/reason.hpp"
#include "sim_host/identify/machine_value.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostEntries = 1000;

bool is_only_the_end_of_the_cut(const Health& health) {
  const auto reason = static_cast<ReasonCode>(health.reason);
  return health.state == HealthState::kNotEnoughData &&
         (reason == ReasonCode::kWearNoContact || reason == ReasonCode::kWearSettling);
}

}  // namespace

bool is_described(const ReplayResult& result, Parameter parameter) {
  const bool is_of_feed = parameter == Parameter::kMass || parameter == Parameter::kContactForce;
  return is_of_feed ? result.has_feed : result.has_spindle;
}

std::string reason_of(const ReplayResult& result, Parameter parameter) {
  if (!is_described(result, parameter)) return "the machine file does not describe it";
  const ParameterEstimate& estimate = result.last.parameters[index_of(parameter)];
  const ParameterStatus status = estimate.status;
  if (status == ParameterStatus::kIdentifiable && estimate.partner == Partner::kContactOffset)
    return kWithContactOffset;
  const std::string reason = reason_of(estimate);
  const bool excites_too_little =
      status == ParameterStatus::kNoExcitation || status == ParameterStatus::kCorrelated;
  return excites_too_little ? fmt::format("{}; it needs {}", reason, excitation_for(value_of(parameter)))
                            : reason;
}

Health verdict_of(const ReplayResult& result) {
  if (result.has_chip_load() && is_only_the_end_of_the_cut(result.last)) return result.judged;
  Health verdict = result.last;
  if (verdict.state != HealthState::kModelGap || result.can_judge_tool) return verdict;
  verdict.state = HealthState::kNotEnoughData;
  verdict.reason = static_cast<std::uint16_t>(ReasonCode::kSensorMissing);
  return verdict;
}

ReasonText verdict_reason(const ReplayResult& result) {
  const Health verdict = verdict_of(result);
  if (result.has_contact || verdict.state != HealthState::kNotEnoughData)
    return text_of(static_cast<ReasonCode>(verdict.reason));
  return {ReasonCode::kNone, "TOOL_NOT_DESCRIBED",
          "The machine file does not have both [tool] and [contact], so nothing can be said about the tool.",
          "Only the axes were described.", "Add the tables [tool] and [contact] to the machine file."};
}

void ResultCollector::take(const SensorFrame& frame, const BoardMonitor& monitor) {
  const Health& health = monitor.health();
  ++kept_.frames;
  time_us_ = std::max(time_us_, unwrapped(frame.time_us, time_us_));
  kept_.seen = static_cast<std::uint16_t>(kept_.seen | frame.present);
  if (frame.has(Channel::kChipLoad)) commanded_mm_ = frame.get(Channel::kChipLoad);
  if (health.frame_flags != 0) count_flags(health.frame_flags);
  note_change(health);
  if (health.chip_load_state != ChipLoadState::kValid) return;
  kept_.judged = health;
  kept_.judged_time_s = seconds(time_us_);
  kept_.commanded_chip_load_mm = commanded_mm_;
  for (std::size_t i = 0; i < monitor.hypothesis_count(); ++i) kept_.probability[i] = monitor.probability(i);
}

void ResultCollector::count_flags(std::uint16_t flags) {
  for (std::size_t bit = 0; bit < flag_counts_.size(); ++bit) flag_counts_[bit] += (flags >> bit) & 1U;
}

void ResultCollector::note_change(const Health& health) {
  const bool is_valid = health.chip_load_state == ChipLoadState::kValid;
  TimelineEntry entry{.time_s = 0.0,
                      .state = health.state,
                      .reason = health.reason,
                      .chip_load_state = health.chip_load_state,
                      .selected_hypothesis = is_valid ? health.selected_hypothesis : std::uint8_t{0}};
  if (!kept_.timeline.empty()) {
    entry.time_s = kept_.timeline.back().time_s;
    if (entry == kept_.timeline.back()) return;
  }
  entry.time_s = seconds(time_us_);
  ++kept_.timeline_changes;
  if (kept_.timeline.size() == kMostEntries) kept_.timeline.pop_back();
  kept_.timeline.push_back(entry);
}

void ResultCollector::finish(const BoardMonitor& monitor, ReplayResult& result) const {
  result.last = monitor.health();
  result.judged = kept_.judged.chip_load_state == ChipLoadState::kValid ? kept_.judged : result.last;
  result.judged_time_s = kept_.judged_time_s;
  result.commanded_chip_load_mm = kept_.commanded_chip_load_mm;
  result.probability = kept_.probability;
  result.timeline = kept_.timeline;
  result.timeline_changes = kept_.timeline_changes;
  result.frames = kept_.frames;
  result.seen = kept_.seen;
  for (std::size_t i = 0; i < monitor.hypothesis_count(); ++i) {
    // Rounded for reading: the monitor holds float32.
    result.hypotheses_mm.push_back(std::stod(std::to_string(monitor.hypothesis_mm(i))));
  }
  for (std::uint16_t bit = 0; bit < kFrameFlagCount; ++bit) {
    if (flag_counts_[bit] == 0) continue;
    result.reasons.emplace(name_of(static_cast<FrameFlag>(1U << bit)), flag_counts_[bit]);
  }
}

}  // namespace morepro::host
