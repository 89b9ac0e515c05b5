#include "sim_host/diagnose/signals/slow_motion.hpp"

#include <cmath>

namespace morepro::host {
namespace {

constexpr double kFastEnoughHz = 200.0;

/// By how much a mass is elsewhere at the end of intervals of `factor` samples if the mean force acts on it
/// instead of the force: root of the mean square.
double error_of_means_m(const RecordingSignals& signals, std::size_t factor, double mass_kg) {
  const auto& force_n = signals.value[index_of(Channel::kFeedForce)];
  const double step_s = 1.0 / signals.rate_hz;
  double squares = 0.0;
  double intervals = 0.0;
  for (std::size_t first = 0; first + factor <= force_n.size(); first += factor) {
    double error = 0.0;  // a force acts on the place for as long as there is left
    for (std::size_t i = 0; i < factor; ++i) {
      const double from_middle = 0.5 * static_cast<double>(factor - 1) - static_cast<double>(i);
      error += static_cast<double>(force_n[first + i]) * from_middle;
    }
    if (std::isnan(error)) continue;
    squares += error * error;
    intervals += 1.0;
  }
  return intervals > 0.0 ? std::sqrt(squares / intervals) * step_s * step_s / mass_kg : 0.0;
}

bool is_position_only(const RecordingSignals& signals) {
  return signals.has(Channel::kFeedPosition) && !signals.has(Channel::kFeedSpeed) &&
         !signals.has(Channel::kSpindleSpeed);
}

}  // namespace

std::optional<RecordingSignals> slow_motion_of(const RecordingSignals& signals,
                                               const MonitorConfiguration& machine) {
  const auto factor = static_cast<std::size_t>(signals.rate_hz / kFastEnoughHz);
  if (factor < 2 || !is_position_only(signals)) return std::nullopt;
  const double error_m = error_of_means_m(signals, factor, machine.machine.feed.mass_kg);
  if (error_m > machine.sensors[Channel::kFeedPosition].noise) return std::nullopt;
  return thinned(signals, factor);
}

}  // namespace morepro::host
