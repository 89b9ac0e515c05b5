#include "sim_host/diagnose/signals/reference_scales.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/simulate/operating_point.hpp"

namespace morepro::host {
namespace {

/// The size that nine of ten samples stay below; 0 where there are none.
double usual_size(const std::vector<float>& column) {
  std::vector<float> sizes;
  for (const float value : column)
    if (value == value) sizes.push_back(std::fabs(value));
  if (sizes.empty()) return 0.0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
  std::nth_element(sizes.begin(), place, sizes.end());
  return static_cast<double>(*place);
}

double usual_feed_speed(const RecordingSignals& signals) {
  if (signals.has(Channel::kFeedSpeed)) return usual_size(signals.value[index_of(Channel::kFeedSpeed)]);
  constexpr std::size_t kStride = 20;  // resolution of the position divided by it is no speed
  const auto& position = signals.value[index_of(Channel::kFeedPosition)];
  std::vector<float> speeds;
  for (std::size_t i = kStride; i < position.size(); i += kStride)
    speeds.push_back((position[i] - position[i - kStride]) * static_cast<float>(signals.rate_hz / kStride));
  return usual_size(speeds);
}

void take_travel(const RecordingSignals& signals, gap::ReferencePoint& point) {
  double place = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  const auto& position = signals.value[index_of(Channel::kFeedPosition)];
  const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
  double origin = std::nan("");
  for (std::size_t i = 0; i < signals.rows; ++i) {
    if (!position.empty()) {
      if (!(position[i] == position[i])) continue;
      if (std::isnan(origin)) origin = static_cast<double>(position[i]);
      place = static_cast<double>(position[i]) - origin;
    } else if (!speed.empty() && speed[i] == speed[i]) {
      place += static_cast<double>(speed[i]) / signals.rate_hz;
    }
    lowest = std::min(lowest, place);
    highest = std::max(highest, place);
  }
  point.travel_from_m = lowest;
  point.travel_m = std::max(highest - lowest, 1.0e-6);
}

void take_if_known(double value, double& target) {
  if (value > 0.0) target = value;
}

}  // namespace

gap::ReferencePoint reference_point_for(const MachineDescription& machine, const RecordingSignals& signals) {
  gap::ReferencePoint point = reference_point_of(machine.configuration.machine);
  if (!machine.has_contact) {
    take_if_known(usual_size(signals.value[index_of(Channel::kSpindleSpeed)]), point.speed_rad_s);
    take_if_known(usual_size(signals.value[index_of(Channel::kArmatureCurrent)]), point.current_a);
    take_if_known(usual_feed_speed(signals), point.feed_speed_m_s);
  }
  take_if_known(usual_size(signals.value[index_of(Channel::kFeedForce)]), point.feed_force_n);
  take_travel(signals, point);
  return point;
}

}  // namespace morepro::host
