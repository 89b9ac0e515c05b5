#include "sim_host/diagnose/leftover/wandering.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/diagnose/fit/white_innovations.hpp"

namespace morepro::host {
namespace {

// What means know of those before, but for the last one. Random forces of up to 8 ms left 0 in 150 machines
// without a gap (tests/blind and three other simulators), of 20 ms 0.016 per mean; pulses of 0.1 s every 0.27
// s 0.18, a sensor whose gain jumps every second 1.4.
constexpr double kWanderingS = 0.04;
constexpr double kLeastOfAll = 40.0;
constexpr double kLeastOfEach = 0.05;

/// By how much more is predictable of shorter means, which is what it is worth.
constexpr double kShortS = 0.01;

double predictable_of_means(double seconds, const AxisFit& fit) {
  constexpr std::size_t kBeforeLast = 2;
  const auto rows = static_cast<std::size_t>(std::max(seconds * fit.signals().rate_hz, 1.0));
  return slowly_predictable_deviance(fit.innovations(), rows, kBeforeLast);
}

/// Of the random forces that an observer of the spindle needs, as shares of its sensors' noise.
double torque_share_of(const AxisFit& fit) {
  if (fit.axis() == Axis::kFeed) return 0.0;
  const gap::GapNoise<double>& noise = fit.model().noise;
  const double torque = noise.speed_step / std::sqrt(noise.speed_variance);
  const double voltage = noise.current_step / std::sqrt(noise.current_variance);
  return torque / (torque + voltage);
}

}  // namespace

Wandering wandering_of(const AxisFit& fit) {
  const double deviance = predictable_of_means(kWanderingS, fit);
  const double means = fit.innovations().total_rows() / std::max(kWanderingS * fit.signals().rate_hz, 1.0);
  if (!(deviance > std::max(kLeastOfAll, kLeastOfEach * means))) return {};
  return {.deviance = std::max(deviance, predictable_of_means(kShortS, fit)),
          .torque_share = torque_share_of(fit)};
}

}  // namespace morepro::host
