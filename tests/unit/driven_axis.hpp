#pragma once
#include <cmath>
#include <functional>
#include <random>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {

/// A feed axis behind a plain controller that sees its state itself, not the samples, integrated here: what
/// its forces and its mass do is the test's.
struct DrivenAxis {
  double rate_hz = 5000.0;
  std::size_t rows = 40000;
  bool has_speed = true;             ///< is the speed recorded, or the position alone?
  double position_noise_m = 1.0e-6;  ///< standard deviation
  /// Share of the datasheet's mass at a place in m.
  std::function<double(double)> mass_at = [](double) { return 1.0; };
  /// Against the motion, in N, at a speed in m/s.
  std::function<double(double)> brake_at = [](double) { return 0.0; };
  double random_force_n = 0.0;  ///< standard deviation, another one in each row
};

/// Where the axis is to be: slowly along all of its way, and shaken, so that no place has a force of its own.
inline double wanted_m(double time_s) {
  return 0.05 * std::sin(time_s) + 0.004 * std::sin(31.0 * time_s) + 0.001 * std::sin(83.0 * time_s);
}

inline RecordingSignals record(const DrivenAxis& axis) {
  constexpr int kSteps = 20;
  const double step_s = 1.0 / (axis.rate_hz * kSteps);
  const MonitorConfiguration configuration = reference_configuration();
  const auto& feed = configuration.machine.feed;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = axis.rate_hz;
  signals.rows = axis.rows;
  double place_m = 0.0;
  double speed_m_s = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double behind_m = wanted_m(signals.time_s(row)) - place_m;
    const double force_n = feed.mass_kg * (4.0e4 * behind_m - 300.0 * speed_m_s);
    show(signals, Channel::kFeedForce, force_n);
    if (axis.has_speed)
      show(signals, Channel::kFeedSpeed,
           speed_m_s + configuration.sensors[Channel::kFeedSpeed].noise * normal(random));
    show(signals, Channel::kFeedPosition, place_m + axis.position_noise_m * normal(random));
    const double random_n = axis.random_force_n * normal(random);
    for (int step = 0; step < kSteps; ++step) {
      const double left_n =
          force_n + random_n - feed.viscous_friction_ns_m * speed_m_s - axis.brake_at(speed_m_s);
      const double mass_kg = feed.mass_kg * axis.mass_at(place_m) + 0.5 * step_s * feed.viscous_friction_ns_m;
      const double change_m_s = step_s * left_n / mass_kg;
      place_m += step_s * (speed_m_s + 0.5 * change_m_s);
      speed_m_s += change_m_s;
    }
  }
  return signals;
}

}  // namespace morepro::diagnose_test
