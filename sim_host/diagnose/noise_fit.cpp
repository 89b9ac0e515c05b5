#include "sim_host/diagnose/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim_host/diagnose/innovation_pass.hpp"

namespace morepro::host {
namespace {

constexpr double kMostShare = 100.0;
constexpr std::size_t kStretches = 4;
constexpr std::size_t kStretchRows = 2500;
constexpr std::size_t kSettling = 200;

double unlikeliness(Axis axis, const RecordingSignals& signals, const GapModel& model) {
  double sum = 0.0;
  const std::size_t length = std::min(kStretchRows, std::max<std::size_t>(signals.rows / kStretches, 1));
  for (std::size_t i = 0; i < kStretches; ++i) {
    const std::size_t first = i * (signals.rows - length) / (kStretches - 1);
    run_observer(axis, signals, model, {}, first, first + length, [&](const Innovation& v) {
      if (v.row < first + kSettling) return;
      const double square = v.value * v.value / v.variance;
      // Beyond three deviations it grows like a heavy tail: outliers do not choose the noise.
      sum += std::log(v.variance) + (square < 9.0 ? square : 9.0 + 9.0 * std::log(square / 9.0));
    });
  }
  return sum;
}

/// `value` is part of the model, between `least` and `most`.
void search(Axis axis, const RecordingSignals& signals, GapModel& model, double& value, double least,
            double most) {
  double best = unlikeliness(axis, signals, model);
  for (const double factor : {4.0, 0.25, 1.6, 0.625}) {
    for (;;) {
      const double before = value;
      value = std::clamp(value * factor, least, most);
      const double other = value == before ? best : unlikeliness(axis, signals, model);
      if (other < best - 1.0) {
        best = other;
        continue;
      }
      value = before;
      break;
    }
  }
}

}  // namespace

gap::GapNoise<double> usual_noise(const Sensors& sensors) {
  gap::GapNoise<double> noise;
  noise.speed_variance = sensors[Channel::kSpindleSpeed].variance();
  noise.current_variance = sensors[Channel::kArmatureCurrent].variance();
  noise.feed_speed_variance = sensors[Channel::kFeedSpeed].variance();
  noise.feed_position_variance = sensors[Channel::kFeedPosition].variance();
  noise.speed_step = kUsualNoiseShare * std::sqrt(noise.speed_variance);
  noise.current_step = kUsualNoiseShare * std::sqrt(noise.current_variance);
  noise.feed_step = kUsualNoiseShare * std::sqrt(noise.feed_speed_variance);
  return noise;
}

void fit_noise(Axis axis, const RecordingSignals& signals, const gap::GapNoise<double>& stated,
               double least_share, GapModel& model) {
  auto& noise = model.noise;
  const auto search_step = [&](double& step, double sensor_variance) {
    const double sensor = std::sqrt(sensor_variance);
    search(axis, signals, model, step, least_share * sensor, kMostShare * sensor);
  };
  if (axis == Axis::kFeed) {
    search_step(noise.feed_step, noise.feed_speed_variance);
    // Position by itself: whether the file's noise of a good encoder is right decides what speed is worth.
    if (signals.is_thinned)
      search(axis, signals, model, noise.feed_position_variance, 1.0e-3 * stated.feed_position_variance,
             stated.feed_position_variance);
    return;
  }
  for (int round = 0; round < 2; ++round) {
    search_step(noise.speed_step, noise.speed_variance);
    search_step(noise.current_step, noise.current_variance);
  }
}

}  // namespace morepro::host
