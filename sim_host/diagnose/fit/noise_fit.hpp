#pragma once
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// Process noise per sample as a share of the sensor's, both as standard deviations. With the usual share an
/// observer remembers some hundred samples.
inline constexpr double kUsualNoiseShare = 0.01;
inline constexpr double kLittleNoiseShare = 1.0e-4;
/// With this one it trusts its sensors: one step ahead parameters and sizes are hardly more than a linear
/// regression has them, wherever they begin, and random forces may move an axis by more than its sensors'
/// noise.
inline constexpr double kTrustingNoiseShare = 3.0;
inline constexpr double kLargestNoiseShare = 100.0;

/// Of the process noise, as shares of the sensor's.
struct NoiseBounds {
  double least_share = kUsualNoiseShare;
  double most_share = kLargestNoiseShare;
};

/// Sensor variances of the machine file, and the usual process noise.
gap::GapNoise<double> usual_noise(const Sensors& sensors);

/// Sets the process noise of both axes to that share of their sensors' noise.
void expect_process_noise(double share, gap::GapNoise<double>& noise);

/// Chooses the process noise of one axis under which the innovations are most likely, on some stretches from
/// all over `within`, shorter ones for a rough answer; within `bounds`. Of a thinned recording the position's
/// noise too, which may be less than `stated`, the machine file's. Has it changed?
bool fit_noise(Axis axis, const RecordingSignals& signals, const Stretch& within,
               const gap::GapNoise<double>& stated, const NoiseBounds& bounds, bool is_rough,
               GapModel& model);

}  // namespace morepro::host
