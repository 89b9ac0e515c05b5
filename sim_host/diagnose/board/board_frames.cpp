#include "sim_host/diagnose/board/board_frames.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "lib/monitor/monitor.hpp"
#include "sim_host/machine/monitor_effects.hpp"

namespace morepro::host {
namespace {

gap::GapFrame<float> rounded(const gap::GapFrame<double>& frame) {
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const auto& in = frame.input;
  gap::GapFrame<float> seen;
  seen.input = {to_float(in.armature_voltage_v), to_float(in.feed_force_n),
                in.contact > 0.5 ? 1.0F : 0.0F,  to_float(in.engagement),
                to_float(in.chip_load_mm),       to_float(in.tool_temperature_degc)};
  seen.winding_degc = to_float(frame.winding_degc);
  seen.speed_rad_s = to_float(frame.speed_rad_s);
  seen.current_a = to_float(frame.current_a);
  seen.angle_rad = to_float(frame.angle_rad);
  seen.feed_speed_m_s = to_float(frame.feed_speed_m_s);
  seen.feed_position_m = to_float(frame.feed_position_m);
  seen.has_speed = frame.has_speed;
  seen.has_current = frame.has_current;
  seen.has_angle = frame.has_angle;
  seen.has_feed_speed = frame.has_feed_speed;
  seen.has_feed_position = frame.has_feed_position;
  return seen;
}

/// An axis is watched where its input is known: else there is nothing to predict with.
void hide_what_is_not_driven(const RecordingSignals& signals, gap::GapFrame<float>& frame) {
  if (!signals.has(Channel::kArmatureVoltage) || signals.is_current_driven)
    frame.has_speed = frame.has_current = false;
  if (!signals.has(Channel::kFeedForce)) frame.has_feed_speed = frame.has_feed_position = false;
}

std::vector<BoardFrame> frames_as_recorded(const RecordingSignals& signals,
                                           const MachineParameters& machine) {
  std::vector<BoardFrame> frames(signals.rows);
  FrameSource source(signals, machine, 0, FrameSource::Temperatures::kAsRecorded);
  for (std::size_t row = 0; row < signals.rows; ++row) {
    gap::GapFrame<float>& frame = frames[row].frame = rounded(source.next());
    const bool is_measured =
        frame.has_speed || frame.has_current || frame.has_feed_speed || frame.has_feed_position;
    frames[row].is_missing = is_missing(signals, row);
    frames[row].is_lost = frames[row].is_missing || !is_measured;
    hide_what_is_not_driven(signals, frame);
  }
  return frames;
}

SensorFrame sampled(const RecordingSignals& signals, std::size_t row) {
  SensorFrame frame;
  frame.sequence = static_cast<std::uint32_t>(row);
  frame.time_us = static_cast<std::uint32_t>(std::llround(1.0e6 * signals.time_s(row)));
  for (std::size_t i = 0; i < kChannelCount; ++i)
    if (const auto& column = signals.value[i]; !column.empty() && !std::isnan(column[row]))
      frame.set(static_cast<Channel>(i), column[row]);
  return frame;
}

/// Of the machine without the effects that it is known to have.
void take_out_known(const RecordingSignals& signals, BoardMonitor& monitor, std::vector<BoardFrame>& frames) {
  for (std::size_t row = 0; row < signals.rows; ++row) {
    if (frames[row].is_missing) continue;
    const SensorFrame seen = sampled(signals, row);
    monitor.step(seen);
    frames[row].frame = GapTracker::frame_of(monitor.held(), seen.present);
    hide_what_is_not_driven(signals, frames[row].frame);
  }
}

}  // namespace

std::vector<BoardFrame> board_frames(const RecordingSignals& signals, const MachineDescription& machine,
                                     const MachineParameters& refitted) {
  std::vector<BoardFrame> frames = frames_as_recorded(signals, machine.configuration.machine);
  MachineDescription board = machine;
  board.configuration.machine = refitted;
  board.configuration.sampling.rate_hz = signals.rate_hz;
  std::vector<std::string> notices;
  know_effects(board, notices);
  if (board.configuration.effects.count == 0) return frames;
  const auto monitor = std::make_unique<BoardMonitor>();
  if (monitor->configure(board.configuration).ok()) take_out_known(signals, *monitor, frames);
  return frames;
}

}  // namespace morepro::host
