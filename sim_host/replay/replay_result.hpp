#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor.hpp"
#include "lib/monitor/reason.hpp"
#include "sim_host/recording/recording_info.hpp"

namespace morepro::host {

/// From `time_s` on the monitor said this, until the next entry.
struct TimelineEntry {
  double time_s = 0.0;
  HealthState state = HealthState::kNotEnoughData;
  std::uint16_t reason = 0;
  ChipLoadState chip_load_state = ChipLoadState::kUndetermined;
  std::uint8_t selected_hypothesis = 0;

  friend bool operator==(const TimelineEntry&, const TimelineEntry&) = default;
};

/// One part of the evaluation, and why it could not be done.
struct EvaluatedPart {
  std::string name;
  bool is_evaluated = false;
  std::string reason;  ///< why not; where it was evaluated, what the monitor has against the model
};

/// What a replay found. The answer on the chip load is the last valid one: a recording often ends after the
/// cut.
struct ReplayResult {
  RecordingInfo info;
  RecordingTally tally;
  std::string damage;  ///< what is wrong with the recording's end or bytes; empty: whole
  std::string machine_name;
  bool has_spindle = true;  ///< the machine is described in this part
  bool has_feed = true;
  bool has_contact = true;
  std::uint16_t seen = 0;  ///< bit_of(channel): at least one sample was there
  MonitorConfiguration configuration;

  Health last;               ///< after the last frame
  Health judged;             ///< after the last frame with a valid chip load; `last` where there was none
  double judged_time_s = 0;  ///< of that frame
  float commanded_chip_load_mm = 0.0F;  ///< with that frame; 0: not recorded
  std::vector<double> hypotheses_mm;
  std::array<float, kMonitorHypotheses> probability{};  ///< after that frame

  std::map<std::string, std::uint64_t> reasons;  ///< frames by what was unusual about them
  std::vector<TimelineEntry> timeline;
  std::uint64_t timeline_changes = 0;  ///< may be more than are listed
  std::vector<EvaluatedPart> parts;
  bool can_judge_tool = true;  ///< the machine file and the recording hold what a word on the tool needs
  std::uint64_t frames = 0;
  double elapsed_s = 0.0;

  [[nodiscard]] bool has_chip_load() const { return judged.chip_load_state == ChipLoadState::kValid; }
  /// The thesis's rule selects without probabilities.
  [[nodiscard]] bool has_probability() const {
    return has_chip_load() && configuration.rule != DecisionRule::kThesis;
  }
  [[nodiscard]] double frames_per_s() const { return static_cast<double>(frames) / elapsed_s; }
};

/// Why a parameter was not identified, and what would excite it; where it was, what its value rests on,
/// mostly
/// "".
std::string reason_of(const ReplayResult& result, Parameter parameter);
/// Does the machine file say something about the parameter?
bool is_described(const ReplayResult& result, Parameter parameter);

/// The verdict on the whole recording: that of its end, except where the end is only the tool leaving the
/// cut. Where nothing can be said about the tool it is NOT_ENOUGH_DATA; what the monitor has against the rest
/// of the model then stands with the parts.
Health verdict_of(const ReplayResult& result);
/// The words for it: a machine file that describes no tool is not a missing sensor.
ReasonText verdict_reason(const ReplayResult& result);

}  // namespace morepro::host
