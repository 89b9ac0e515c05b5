#include "sim_host/diagnose/fit/shown_by_innovations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace morepro::host {
namespace {

/// The channel of a sensor of an axis, in the order of `Innovation::sensor`; none for the current, which
/// answers the voltage of each row within the row where the winding is fast.
std::optional<Channel> watched_channel(Axis axis, std::size_t sensor) {
  if (axis == Axis::kFeed) return sensor == 0 ? Channel::kFeedPosition : Channel::kFeedSpeed;
  if (sensor == 0) return Channel::kSpindleSpeed;
  return std::nullopt;
}

/// Of the standard deviation that the observer expects of an innovation, which is the sensor's at least.
double white_share(const AxisFit& fit, std::size_t sensor) {
  constexpr std::size_t kDifferences = 1;  // as of a speed: nothing of a motion is left
  return white_noise_of(fit.innovations().normalised[sensor], kDifferences);
}

}  // namespace

std::vector<ShownNoise> noisier_sensors(const RecordingSignals& signals, const Sensors& sensors,
                                        std::span<const AxisFit* const> fits) {
  std::vector<ShownNoise> noisier = noisier_than_stated(signals, sensors);
  if (signals.is_thinned) return noisier;
  for (const AxisFit* fit : fits)
    for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
      const auto channel = watched_channel(fit->axis(), sensor);
      if (!channel || !signals.has(*channel) ||
          std::ranges::count(noisier, *channel, &ShownNoise::channel) > 0)
        continue;
      const double ratio = white_share(*fit, sensor);
      if (auto shown = shown_noise(*channel, ratio * std::sqrt(sensors[*channel].variance()), sensors))
        noisier.push_back(*shown);
    }
  return noisier;
}

}  // namespace morepro::host
