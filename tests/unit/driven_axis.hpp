#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {

/// Where the axis is to be: slowly along all of its way, and shaken, so that no place has a force of its own.
inline double shaken_m(double time_s) {
  return 0.05 * std::sin(time_s) + 0.004 * std::sin(31.0 * time_s) + 0.001 * std::sin(83.0 * time_s);
}

/// From place to place at 0.1 m/s, which sets everything swinging.
inline double moved_m(double time_s) {
  constexpr double kMoveS = 0.37;
  constexpr double kTurns = 0.6180339887;  // irrational: no place comes back
  const auto place_m = [](double move) {
    return 0.015 * std::sin(2.0 * std::numbers::pi * kTurns * move * move);
  };
  const double move = std::floor(time_s / kMoveS);
  const double share = std::min(1.0, (time_s / kMoveS - move) * 1.5);
  return place_m(move) + share * (place_m(move + 1.0) - place_m(move));
}

/// A part of a driven axis that hangs on a spring: a share of the mass, with a frequency by itself.
struct SwingingPart {
  double share = 0.0;
  double frequency_hz = 25.0;
  double damping_ratio = 0.03;
};

/// A feed axis behind a plain controller that sees its state itself, not the samples, integrated here: what
/// its forces and its mass do is the test's.
struct DrivenAxis {
  double rate_hz = 5000.0;
  std::size_t rows = 40000;
  bool has_speed = true;             ///< is the speed recorded, or the position alone?
  double position_noise_m = 1.0e-6;  ///< standard deviation
  double position_step_m = 0.0;      ///< that positions are rounded to; 0: none
  /// Share of the datasheet's mass at a place in m.
  std::function<double(double)> mass_at = [](double) { return 1.0; };
  /// The same at a time in s.
  std::function<double(double)> mass_over_time = [](double) { return 1.0; };
  /// Share of the datasheet's viscous friction at a place in m.
  std::function<double(double)> viscosity_at = [](double) { return 1.0; };
  /// Against the motion, in N, at a speed in m/s.
  std::function<double(double)> brake_at = [](double) { return 0.0; };
  double random_force_n = 0.0;  ///< standard deviation, another one in each row
  /// Share of it at a time in s.
  std::function<double(double)> random_share = [](double) { return 1.0; };
  SwingingPart part{};
  std::function<double(double)> wanted_m = shaken_m;
  MonitorConfiguration configuration = reference_configuration();
};

inline RecordingSignals record(const DrivenAxis& axis) {
  constexpr int kSteps = 20;
  const double step_s = 1.0 / (axis.rate_hz * kSteps);
  const auto& feed = axis.configuration.machine.feed;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  RecordingSignals signals;
  signals.rate_hz = axis.rate_hz;
  signals.rows = axis.rows;
  double place_m = 0.0;
  double speed_m_s = 0.0;
  double stretch_m = 0.0;  // of the spring
  double part_speed_m_s = 0.0;
  const double turn_rate = 2.0 * std::numbers::pi * axis.part.frequency_hz;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double behind_m = axis.wanted_m(signals.time_s(row)) - place_m;
    const double force_n = feed.mass_kg * (4.0e4 * behind_m - 300.0 * speed_m_s);
    show(signals, Channel::kFeedForce, force_n);
    if (axis.has_speed)
      show(signals, Channel::kFeedSpeed,
           speed_m_s + axis.configuration.sensors[Channel::kFeedSpeed].noise * normal(random));
    const double seen_m = place_m + axis.position_noise_m * normal(random);
    const double step_m = axis.position_step_m;
    show(signals, Channel::kFeedPosition, step_m > 0.0 ? step_m * std::round(seen_m / step_m) : seen_m);
    const double share_of_mass = axis.mass_over_time(signals.time_s(row));
    const double random_n = axis.random_force_n * axis.random_share(signals.time_s(row)) * normal(random);
    for (int step = 0; step < kSteps; ++step) {
      const double pull_m_s2 =
          turn_rate * (turn_rate * stretch_m + 2.0 * axis.part.damping_ratio * (speed_m_s - part_speed_m_s));
      part_speed_m_s += step_s * pull_m_s2;
      stretch_m += step_s * (speed_m_s - part_speed_m_s);
      const double part_kg = axis.part.share * feed.mass_kg;
      const double viscous_ns_m = feed.viscous_friction_ns_m * axis.viscosity_at(place_m);
      const double left_n =
          force_n + random_n - viscous_ns_m * speed_m_s - axis.brake_at(speed_m_s) - part_kg * pull_m_s2;
      const double mass_kg =
          feed.mass_kg * share_of_mass * axis.mass_at(place_m) - part_kg + 0.5 * step_s * viscous_ns_m;
      const double change_m_s = step_s * left_n / mass_kg;
      place_m += step_s * (speed_m_s + 0.5 * change_m_s);
      speed_m_s += change_m_s;
    }
  }
  return signals;
}

}  // namespace morepro::diagnose_test
