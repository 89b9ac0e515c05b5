#include "sim_host/diagnose/leftover/wandering.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim_host/diagnose/fit/white_innovations.hpp"
#include "sim_host/diagnose/leftover/left_lines.hpp"

namespace morepro::host {
namespace {

// What means of both sensors know of those before, but for the last one. Of 230 axes without a gap
// (tests/blind and three other simulators, random forces of up to 8 ms) none had more than 5; of 20 ms 0.016
// per mean, pulses of a load every 0.27 s 0.18, a current sensor whose gain jumps every second 1.4.
constexpr double kLeastOfAll = 40.0;
constexpr double kLeastOfEach = 0.05;
constexpr std::size_t kBeforeLast = 2;

/// Of shorter means more is predictable, which is what it is worth.
constexpr double kShortS = 0.01;

/// Of the random forces that an observer of the spindle needs, as shares of its sensors' noise.
double torque_share_of(const AxisFit& fit) {
  if (fit.axis() == Axis::kFeed) return 0.0;
  const gap::GapNoise<double>& noise = fit.model().noise;
  const double torque = noise.speed_step / std::sqrt(noise.speed_variance);
  const double voltage = noise.current_step / std::sqrt(noise.current_variance);
  return torque / (torque + voltage);
}

/// Does an observer expect so many random forces that it takes its sensors' noise for them? What it leaves
/// has to be summed up again, and with it what is slow and otherwise far below the noise.
bool takes_noise_for_forces(const SensorWhitening& whitening) {
  // By so much a memory enlarges what does not change; beside loads that wander 1.1.
  constexpr double kMost = 1.5;
  return 1.0 - std::accumulate(whitening.memory.begin(), whitening.memory.end(), 0.0) > kMost;
}

}  // namespace

std::size_t rows_of_mean(double seconds, const AxisFit& fit) {
  return static_cast<std::size_t>(std::max(seconds * fit.signals().rate_hz, 1.0));
}

Wandering wandering_of(const AxisFit& fit) {
  const GapStatistics& innovations = fit.innovations();
  const Whitening whitening = whitening_of(innovations);
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor)
    if (shows_its_steps(fit, innovations, sensor) || takes_noise_for_forces(whitening[sensor])) return {};
  const std::size_t rows = rows_of_mean(kLongS, fit);
  const double deviance = slowly_predictable_deviance(innovations, rows, kBeforeLast);
  const double means = innovations.total_rows() / static_cast<double>(rows);
  if (!(deviance > std::max(kLeastOfAll, kLeastOfEach * means))) return {};
  const double of_short = slowly_predictable_deviance(innovations, rows_of_mean(kShortS, fit), kBeforeLast);
  return {.deviance = std::max(deviance, of_short), .torque_share = torque_share_of(fit)};
}

}  // namespace morepro::host
