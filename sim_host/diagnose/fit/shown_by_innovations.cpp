#include "sim_host/diagnose/fit/shown_by_innovations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace morepro::host {
namespace {

/// The channel of a sensor of an axis, in the order of `Innovation::sensor`; none for the current of a
/// winding that answers the voltage of each row within the row.
std::optional<Channel> watched_channel(const AxisFit& fit, std::size_t sensor) {
  constexpr double kRowsOfAnswer = 2.0;
  const Channel channel = channel_of(fit.axis(), sensor);
  if (channel != Channel::kArmatureCurrent) return channel;
  const MachineParameters::Spindle& spindle = fit.model().machine.spindle;
  const double rows = spindle.inductance_h / spindle.resistance_ohm * fit.signals().rate_hz;
  if (rows > kRowsOfAnswer) return channel;
  return std::nullopt;
}

/// Standard deviation of what is white in what a model leaves of a sensor, without what the model does not
/// know of the machine; 0 where that is most of it by far, and tells little of the sensor. `stated`: its
/// variance.
double white_deviation(const AxisFit& fit, std::size_t sensor, double stated) {
  constexpr std::size_t kDifferences = 1;  // as of a speed: nothing of a motion is left
  constexpr double kMostly = 4.0;          // observers of a sensor twice as noisy as stated believed in 2.5
  const GapStatistics& left = fit.innovations();
  const auto rows = static_cast<double>(left.normalised[sensor].size());
  if (!(rows > 0.0)) return 0.0;
  const double expected = std::exp(left.log_variance[sensor] / rows);
  if (!(expected < kMostly * stated)) return 0.0;
  const double white = white_noise_of(left.normalised[sensor], kDifferences);
  return std::sqrt(std::max(0.0, white * white * expected - (expected - stated)));
}

}  // namespace

std::vector<ShownNoise> noisier_sensors(const RecordingSignals& signals, const Sensors& sensors,
                                        std::span<const AxisFit* const> fits) {
  std::vector<ShownNoise> noisier = noisier_than_stated(signals, sensors);
  if (signals.is_thinned) return noisier;
  for (const AxisFit* fit : fits)
    for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
      const auto channel = watched_channel(*fit, sensor);
      if (!channel || !signals.has(*channel) ||
          std::ranges::count(noisier, *channel, &ShownNoise::channel) > 0)
        continue;
      const double deviation = white_deviation(*fit, sensor, sensors[*channel].variance());
      if (const auto shown = shown_noise(*channel, deviation, sensors)) noisier.push_back(*shown);
    }
  return noisier;
}

}  // namespace morepro::host
