#include "sim_host/diagnose/recording_signals.hpp"

#include <cmath>

namespace morepro::host {
namespace {

constexpr double kWindingDegc = 25.0;
constexpr double kSlowS = 0.004;  // a temperature's sensor is averaged over so long: no tool heats as fast

}  // namespace

RecordingSignals thinned(const RecordingSignals& signals, std::size_t factor) {
  RecordingSignals thin;
  thin.is_thinned = true;
  thin.rate_hz = signals.rate_hz / static_cast<double>(factor);
  thin.start_s = signals.start_s;
  thin.rows = signals.rows / factor;
  thin.missing_rows = signals.missing_rows / factor;
  thin.recorded = signals.recorded;
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    const auto& from = signals.value[c];
    if (from.empty()) continue;
    const bool is_input = kChannels[c].kind == ChannelKind::kHeldInput;
    for (std::size_t row = 0; row < thin.rows; ++row) {
      float sum = 0.0F;
      for (std::size_t i = 0; i < factor; ++i) sum += from[row * factor + i];
      thin.value[c].push_back(is_input ? sum / static_cast<float>(factor) : from[row * factor]);
    }
  }
  return thin;
}

FrameSource::FrameSource(const RecordingSignals& signals, const MachineParameters& machine, std::size_t first)
    : signals_(signals), row_(first), winding_{.value = kWindingDegc} {
  input_.engagement = machine.feed.engagement;
  input_.chip_load_mm = machine.tool.chip_load_mm;
  tool_.value = machine.thermal.tool_degc;
  if (!signals.has(Channel::kContact)) return;
  for (std::size_t row = 0; row < first; ++row) {
    double contact = 0.0;
    const float value = signals.value[index_of(Channel::kContact)][row];
    if (!std::isnan(value)) contact = static_cast<double>(value);
    cutting_time_s_ += contact / signals.rate_hz;
  }
}

double FrameSource::held(Channel channel, double& value) const {
  sampled(channel, value);
  return value;
}

bool FrameSource::sampled(Channel channel, double& value) const {
  const auto& column = signals_.value[index_of(channel)];
  if (column.empty() || std::isnan(column[row_])) return false;
  value = static_cast<double>(column[row_]);
  return true;
}

void FrameSource::follow(Channel channel, SlowSignal& signal) const {
  double measured = 0.0;
  if (!sampled(channel, measured)) return;
  const double share = signal.is_measured ? 1.0 / (1.0 + kSlowS * signals_.rate_hz) : 1.0;
  signal.value += share * (measured - signal.value);
  signal.is_measured = true;
}

gap::GapFrame<double> FrameSource::next() {
  gap::GapFrame<double> frame;
  held(Channel::kArmatureVoltage, input_.armature_voltage_v);
  held(Channel::kFeedForce, input_.feed_force_n);
  held(Channel::kContact, input_.contact);
  held(Channel::kEngagement, input_.engagement);
  held(Channel::kChipLoad, input_.chip_load_mm);
  follow(Channel::kToolTemperature, tool_);
  follow(Channel::kWindingTemperature, winding_);
  input_.tool_temperature_degc = tool_.value;
  frame.time_s = signals_.time_s(row_);
  frame.input = input_;
  frame.winding_degc = winding_.value;
  frame.cutting_time_s = cutting_time_s_;
  frame.has_speed = sampled(Channel::kSpindleSpeed, frame.speed_rad_s);
  frame.has_current = sampled(Channel::kArmatureCurrent, frame.current_a);
  frame.has_angle = sampled(Channel::kSpindleAngle, frame.angle_rad);
  frame.has_feed_speed = sampled(Channel::kFeedSpeed, frame.feed_speed_m_s);
  frame.has_feed_position = sampled(Channel::kFeedPosition, frame.feed_position_m);
  cutting_time_s_ += input_.contact / signals_.rate_hz;
  ++row_;
  return frame;
}

}  // namespace morepro::host
