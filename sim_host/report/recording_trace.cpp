#include "sim_host/report/recording_trace.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sim_host/report/channel_label.hpp"

namespace morepro::host {
namespace {

std::string key(std::size_t channel) { return fmt::format("recording.{}", kChannels[channel].column); }

/// Contact is one of the phases, and an angle only ever grows.
bool is_shown(std::size_t channel) {
  return static_cast<Channel>(channel) != Channel::kContact &&
         static_cast<Channel>(channel) != Channel::kSpindleAngle;
}

SensorFrame frame_of(const RecordingSignals& signals, std::size_t row) {
  SensorFrame frame;
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (row < signals.value[c].size() && std::isfinite(signals.value[c][row]))
      frame.set(static_cast<Channel>(c), signals.value[c][row]);
  return frame;
}

Json turning(const std::array<double, 3>& sums, int teeth) {
  const double mean = sums[1] / sums[0];
  const double deviation = std::sqrt(std::fmax(sums[2] / sums[0] - mean * mean, 0.0));
  return {{"mean_hz", mean / (2.0 * std::numbers::pi)}, {"spread", deviation / mean}, {"teeth", teeth}};
}

}  // namespace

Json runs_of(const Pyramid& pyramid) {
  Json runs = Json::array();
  Json last = "none yet";
  const std::vector<Bucket> buckets = pyramid.buckets();
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const Json now = buckets[i].is_empty() ? Json(nullptr) : Json(std::lround(buckets[i].high));
    if (now == last) continue;
    runs.push_back({i, now});
    last = now;
  }
  return runs;
}

int teeth_of(const MachineDescription& machine) {
  return machine.has_contact ? static_cast<int>(machine.configuration.machine.tool.teeth) : 0;
}

RecordingTrace::RecordingTrace(double row_s, const Sensors& sensors, std::size_t most_buckets)
    : watch_(sensors), table_(row_s, most_buckets) {
  for (std::size_t c = 0; c < kChannelCount; ++c)
    columns_[c] =
        table_.add(key(c), std::string(kChannelLabels[c].name), std::string(kChannelLabels[c].unit));
  phase_column_ = table_.add("recording.phase", "", "1");
  missing_column_ = table_.add("recording.missing", "", "1");
}

Phase RecordingTrace::take(std::uint64_t row, const SensorFrame& frame) {
  recorded_ = static_cast<std::uint16_t>(recorded_ | frame.present);
  table_.begin_row(row);
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (is_shown(c) && frame.has(static_cast<Channel>(c)))
      table_.set(columns_[c], static_cast<double>(frame.value[c]));
  const Phase phase = watch_.step(frame);
  table_.set(phase_column_, static_cast<double>(phase));
  if (row > next_row_) missing_ += row - next_row_;
  table_.set(missing_column_, row > next_row_ ? 1.0 : 0.0);
  next_row_ = row + 1;
  if (frame.has(Channel::kSpindleSpeed))
    take_speed(static_cast<double>(frame.get(Channel::kSpindleSpeed)), phase);
  return phase;
}

void RecordingTrace::take_speed(double speed_rad_s, Phase phase) {
  if (phase == Phase::kIdle) return;
  auto& sums = speed_[phase == Phase::kCut ? 1 : 0];
  sums[0] += 1.0;
  sums[1] += std::fabs(speed_rad_s);
  sums[2] += speed_rad_s * speed_rad_s;
}

void RecordingTrace::take_all(const RecordingSignals& signals) {
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const SensorFrame frame = frame_of(signals, row);
    if (frame.present != 0) take(row, frame);
  }
}

void RecordingTrace::add_to(std::uint64_t rows, int teeth, ReportPage& page) {
  table_.finish(rows);
  Json& phases = page.part("phases");
  phases = {
      {"bucket_s", table_.bucket_s()},
      {"tool_change_s", kToolChangeS},
      {"runs", PhaseWatch::can_tell(recorded_) ? runs_of(table_.pyramid(phase_column_)) : Json(nullptr)}};
  page.part("missing") = {{"bucket_s", table_.bucket_s()},
                          {"rows", missing_},
                          {"runs", runs_of(table_.pyramid(missing_column_))}};
  const auto& [air, cut] = speed_;
  if (const auto& spell = cut[0] > 0.0 ? cut : air; spell[0] > 0.0)
    page.part("turning") = turning(spell, teeth);
  page.add(table_);
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    if ((recorded_ >> c & 1U) == 0 || !is_shown(c)) continue;
    page.add(TimeChart{.section = "signals",
                       .title = std::string(kChannelLabels[c].name),
                       .unit = std::string(kChannelLabels[c].unit),
                       .lines = {key(c)}});
  }
}

}  // namespace morepro::host
