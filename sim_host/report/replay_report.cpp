#include "sim_host/report/replay_report.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "lib/monitor/reason.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/replay/names.hpp"
#include "sim_host/report/innovation_statistics.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kMostEvents = 200;
constexpr std::size_t kSeriesOfMonitor = 6;

/// From what one would rather overlook to what one must not: a bucket shows the worst.
constexpr std::array kStates{HealthState::kNotEnoughData, HealthState::kHealthy,     HealthState::kWatch,
                             HealthState::kModelGap,      HealthState::kSensorFault, HealthState::kReplace};

double rank_of(HealthState state) {
  for (std::size_t i = 0; i < kStates.size(); ++i)
    if (kStates[i] == state) return static_cast<double>(i);
  return 0.0;
}

std::size_t buckets_of(const RecordingInfo& recording) {
  const auto recorded = static_cast<std::size_t>(std::popcount(recording.recorded));
  return buckets_for(recorded + 2 * kSeriesPerTrace + kSeriesOfMonitor + kMonitorHypotheses);
}

/// Of the monitor's exponential mean over pairs of innovations.
double ratio_bound() {
  return kTwoSided95 / std::sqrt(2.0 * static_cast<double>(RunningRatio::kMemory) - 1.0);
}

}  // namespace

ReplayReport::ReplayReport(const RecordingReader& recording, const MachineDescription& machine)
    : reader_(recording),
      page_("replay"),
      rate_hz_(recording.info().rate_hz),
      teeth_(teeth_of(machine)),
      recording_(1.0 / rate_hz_, machine.configuration.sensors, buckets_of(recording.info())),
      model_(machine),
      traces_{
          ModelTrace(Axis::kSpindle, "spindle_model", "model", 1.0 / rate_hz_, buckets_of(recording.info())),
          ModelTrace(Axis::kFeed, "feed_model", "model", 1.0 / rate_hz_, buckets_of(recording.info()))},
      monitor_(1.0 / rate_hz_, buckets_of(recording.info())) {
  columns_ = {monitor_.add("monitor.chip_load", "chip load that the torque looks like", "mm"),
              monitor_.add("monitor.chip_load_band", "2 standard errors", "mm"),
              monitor_.add("monitor.commanded", "commanded", "mm"),
              monitor_.add("monitor.wear", "over the commanded one", "1"),
              monitor_.add("monitor.wear_band", "2 standard errors", "1"),
              monitor_.add("monitor.ratio", "monitor on the board", "1"),
              monitor_.add("monitor.state", "", "1"),
              monitor_.add("monitor.gated", "", "1")};
  const MonitorConfiguration& c = machine.configuration;
  if (!machine.has_contact || c.rule == DecisionRule::kThesis) return;
  for (std::size_t j = 0; j < c.grid.count; ++j)
    probability_.push_back(monitor_.add(fmt::format("monitor.probability.{}", j),
                                        fmt::format("{:.4g} mm", c.grid.value_mm(j)), "1"));
}

void ReplayReport::take(const SensorFrame& frame, const BoardMonitor& monitor) {
  const double place = std::round(reader_.tally().duration_s * rate_hz_);
  if (!(place >= static_cast<double>(rows_))) return;  // a repeated frame, or one from before
  const auto row = static_cast<std::uint64_t>(place);
  rows_ = row + 1;
  note_stop(recording_.take(row, frame));
  model_.take(row, frame, [this](Axis axis, const Innovation& v, double measured) {
    traces_[axis == Axis::kSpindle ? 0 : 1].take(v, measured);
  });
  monitor_.begin_row(row);
  take_monitor(frame, monitor);
  note_change(monitor.health());
}

void ReplayReport::note_stop(Phase phase) {
  stopped_rows_ = phase == Phase::kIdle ? stopped_rows_ + 1 : 0;
  may_be_another_tool_ |= static_cast<double>(stopped_rows_) >= kToolChangeS * rate_hz_;
}

void ReplayReport::take_wear(double ratio) {
  if (may_be_another_tool_) wear_.restart();
  may_be_another_tool_ = false;
  wear_.take(static_cast<double>(rows_ - 1) / rate_hz_, ratio);
}

void ReplayReport::note_change(const Health& health) {
  const bool is_first = changes_ == 0;
  if (!is_first && health.state == state_ && health.reason == reason_) return;
  state_ = health.state;
  reason_ = health.reason;
  if (++changes_ > kMostEvents) return;
  const ReasonText reason = text_of(static_cast<ReasonCode>(health.reason));
  events_.push_back({{"time_s", reader_.tally().duration_s},
                     {"state", name_of(health.state)},
                     {"reason", reason.name},
                     {"sentence", reason.sentence},
                     {"cause", reason.cause},
                     {"next_step", reason.next_step}});
}

void ReplayReport::take_monitor(const SensorFrame& frame, const BoardMonitor& monitor) {
  const Health& health = monitor.health();
  monitor_.set(columns_.state, rank_of(health.state));
  const bool is_gated = (health.frame_flags & bits_of(FrameFlag::kInnovationGate)) != 0;
  monitor_.set(columns_.gated, is_gated ? 1.0 : 0.0);
  if (health.innovation_ratio > 0.0F)
    monitor_.set(columns_.ratio, static_cast<double>(health.innovation_ratio));
  if (frame.has(Channel::kChipLoad)) {
    commanded_mm_ = static_cast<double>(frame.get(Channel::kChipLoad));
    monitor_.set(columns_.commanded, commanded_mm_);
  }
  if (health.chip_load_state != ChipLoadState::kValid) return;
  const auto chip_load = static_cast<double>(health.chip_load_mm);
  const auto error = 2.0 * static_cast<double>(health.chip_load_standard_error_mm);
  monitor_.set(columns_.chip_load, chip_load);
  monitor_.set(columns_.error, chip_load - error, chip_load + error);
  if (commanded_mm_ > 0.0) {
    monitor_.set(columns_.wear, chip_load / commanded_mm_);
    take_wear(chip_load / commanded_mm_);
    monitor_.set(columns_.wear_error, (chip_load - error) / commanded_mm_,
                 (chip_load + error) / commanded_mm_);
  }
  for (std::size_t j = 0; j < probability_.size(); ++j)
    monitor_.set(probability_[j], static_cast<double>(monitor.probability(j)));
}

ReportPage& ReplayReport::finish(const ReplayResult& result) {
  recording_.add_to(rows_, teeth_, page_);
  monitor_.finish(rows_);
  for (const std::size_t axis : {0U, 1U}) {
    traces_[axis].finish(rows_);
    const std::array<const ModelTrace*, 1> models{&traces_[axis]};
    add_model_charts(axis == 0 ? Axis::kSpindle : Axis::kFeed, models, page_);
  }
  add_monitor_charts(result);
  page_.set_span(seconds(result.info.start_us), static_cast<double>(rows_) / rate_hz_, rate_hz_);
  return page_;
}

void ReplayReport::add_wear_charts(const WearLimits& limits) {
  page_.add(TimeChart{.section = "wear",
                      .title = "Chip load",
                      .unit = "mm",
                      .lines = {"monitor.commanded", "monitor.chip_load"},
                      .band = "monitor.chip_load_band"});
  TimeChart wear{.section = "wear",
                 .title = "Wear: the chip load that the torque looks like, over the commanded one",
                 .unit = "1",
                 .lines = {"monitor.wear"},
                 .band = "monitor.wear_band",
                 .limits = {{limits.replace_ratio, "REPLACE"},
                            {limits.watch_ratio, "WATCH"},
                            {1.0, "sharp"},
                            {limits.low_ratio, "too little"}}};
  page_.part("wear_trend") = nullptr;
  if (const auto line = wear_.line()) {
    wear.segments = {{line->from_s, line->at_from, line->to_s, line->at(line->to_s), "trend"}};
    page_.part("wear_trend") = {{"from_s", line->from_s},
                                {"to_s", line->to_s},
                                {"slope_per_s", line->slope_per_s},
                                {"standard_error_per_s", line->standard_error_per_s}};
  }
  page_.add(wear);
}

void ReplayReport::add_monitor_charts(const ReplayResult& result) {
  page_.add(monitor_);
  Json names = Json::array();
  for (const HealthState state : kStates) names.push_back(name_of(state));
  page_.part("states") = {{"bucket_s", monitor_.bucket_s()},
                          {"names", std::move(names)},
                          {"runs", runs_of(monitor_.pyramid(columns_.state))}};
  page_.part("gated") = {{"bucket_s", monitor_.bucket_s()},
                         {"runs", runs_of(monitor_.pyramid(columns_.gated))}};
  page_.part("events") = {{"listed", events_}, {"changes", changes_}};
  page_.part("timing") = {{"frames", result.frames}, {"elapsed_s", result.elapsed_s}};
  page_.add(TimeChart{.section = "residuals",
                      .title = fmt::format("Monitor on the board: NIS per degree of freedom over {} frames",
                                           RunningRatio::kMemory),
                      .unit = "1",
                      .lines = {"monitor.ratio"},
                      .limits = {{1.0 - ratio_bound(), ""}, {1.0 + ratio_bound(), "95 %"}},
                      .scale = "log"});
  if (!result.has_contact) return;
  add_wear_charts(result.configuration.wear);
  TimeChart bank{.section = "hypotheses", .title = "Probability of each chip load", .unit = "1", .lines = {}};
  for (std::size_t j = 0; j < probability_.size(); ++j)
    bank.lines.push_back(fmt::format("monitor.probability.{}", j));
  page_.add(bank);
}

}  // namespace morepro::host
