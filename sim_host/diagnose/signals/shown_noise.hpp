#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// A sensor whose noise is another one than its machine file says.
struct ShownNoise {
  Channel channel = Channel::kSpindleSpeed;
  double noise = 0.0;  ///< standard deviation without rounding, unit of the channel
  double ratio = 1.0;  ///< of standard deviations, to what is stated
};

/// Standard deviation of what is white in a column, rounding included; 0 where there is too little to tell,
/// or something else that is as fast. What lasts, random forces on a mass among it, makes it smaller.
/// `differences`: 1, or 2 of a position.
double white_noise_of(std::span<const float> column, std::size_t differences);

/// What a sensor's noise is where it is half as large again as `sensors` says and more; `deviation`: a
/// standard deviation that the sensor shows, rounding included.
std::optional<ShownNoise> shown_noise(Channel channel, double deviation, const Sensors& sensors);

/// Speeds and a position that are noisier than `sensors` says by half and more. Not the current, which
/// answers the voltage of each row within the row where the winding is fast; nor what was thinned.
std::vector<ShownNoise> noisier_than_stated(const RecordingSignals& signals, const Sensors& sensors);

std::string sentence_of(const ShownNoise& shown);

/// The noise of speeds, a position and a current of which the machine file says nothing, `assumed` of
/// bit_of(channel), where they show half as much again as `sensors` says or more, or two thirds or less; the
/// current's where that is less, since it is a bound. A noise ten times too large makes an observer trust its
/// other sensor, and what that does not know becomes structure.
std::vector<ShownNoise> instead_of_assumed(const RecordingSignals& signals, std::uint16_t assumed,
                                           const Sensors& sensors);
std::string sentence_of_assumed(const ShownNoise& shown);

}  // namespace morepro::host
