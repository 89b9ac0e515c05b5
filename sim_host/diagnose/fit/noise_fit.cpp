#include "sim_host/diagnose/fit/noise_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/diagnose/fit/repeated_logarithm.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kStretches = 4;
constexpr std::size_t kStretchRows = 2500;
constexpr std::size_t kRoughRows = 1200;
constexpr std::size_t kNoiseSettling = 200;

/// Over stretches of at most `length` rows, from all over `within`.
double unlikeliness(Axis axis, const RecordingSignals& signals, const Stretch& within, const GapModel& model,
                    std::size_t length) {
  double sum = 0.0;
  const std::size_t rows = within.last - within.first;
  if (rows == 0) return sum;
  length = std::min(length, std::max<std::size_t>(rows / kStretches, 1));
  for (std::size_t i = 0; i < kStretches; ++i) {
    const std::size_t first = within.first + i * (rows - length) / (kStretches - 1);
    std::array<RepeatedLogarithm, kSensorsPerAxis> log;
    run_observer(axis, signals, model, first, first + length, [&](const Innovation& v) {
      if (v.row < first + kNoiseSettling) return;
      const double square = v.value * v.value / v.variance;
      // Beyond three deviations it grows like a heavy tail: outliers do not choose the noise.
      sum += log[v.sensor](v.variance) + (square < 9.0 ? square : 9.0 + 9.0 * std::log(square / 9.0));
    });
  }
  return sum;
}

/// Looks for the process noise that makes some stretches of a recording most likely, one value after another.
class NoiseSearch {
 public:
  NoiseSearch(Axis axis, const RecordingSignals& signals, const Stretch& within, GapModel& model,
              std::size_t length)
      : axis_(axis),
        signals_(signals),
        within_(within),
        model_(model),
        length_(length),
        best_(unlikeliness_now()) {}

  /// `value` is part of the model, between `least` and `most`. Has it changed?
  bool search(double& value, double least, double most) {
    const double start = value;
    for (const double factor : {4.0, 0.25, 1.6, 0.625})
      while (is_better_with(factor, value, least, most)) {
      }
    return value != start;
  }

 private:
  double unlikeliness_now() const { return unlikeliness(axis_, signals_, within_, model_, length_); }
  bool is_better_with(double factor, double& value, double least, double most) {
    const double before = value;
    value = std::clamp(value * factor, least, most);
    const double other = value == before ? best_ : unlikeliness_now();
    if (other < best_ - 1.0) {
      best_ = other;
      return true;
    }
    value = before;
    return false;
  }

  Axis axis_;
  const RecordingSignals& signals_;
  Stretch within_;
  GapModel& model_;
  std::size_t length_;
  double best_;
};

}  // namespace

gap::GapNoise<double> usual_noise(const Sensors& sensors) {
  gap::GapNoise<double> noise;
  noise.speed_variance = sensors[Channel::kSpindleSpeed].variance();
  noise.current_variance = sensors[Channel::kArmatureCurrent].variance();
  noise.feed_speed_variance = sensors[Channel::kFeedSpeed].variance();
  noise.feed_position_variance = sensors[Channel::kFeedPosition].variance();
  expect_process_noise(kUsualNoiseShare, noise);
  return noise;
}

void expect_process_noise(double share, gap::GapNoise<double>& noise) {
  noise.speed_step = share * std::sqrt(noise.speed_variance);
  noise.current_step = share * std::sqrt(noise.current_variance);
  noise.feed_step = share * std::sqrt(noise.feed_speed_variance);
}

bool fit_noise(Axis axis, const RecordingSignals& signals, const Stretch& within,
               const gap::GapNoise<double>& stated, const NoiseBounds& bounds, bool is_rough,
               GapModel& model) {
  auto& noise = model.noise;
  NoiseSearch noises(axis, signals, within, model, is_rough ? kRoughRows : kStretchRows);
  const auto search_step = [&](double& step, double sensor_variance) {
    const double sensor = std::sqrt(sensor_variance);
    return noises.search(step, bounds.least_share * sensor, bounds.most_share * sensor);
  };
  if (axis == Axis::kFeed) {
    bool has_changed = search_step(noise.feed_step, noise.feed_speed_variance);
    // Position by itself: whether the file's noise of a good encoder is right decides what speed is worth.
    if (signals.is_thinned)
      has_changed |= noises.search(noise.feed_position_variance, 1.0e-3 * stated.feed_position_variance,
                                   stated.feed_position_variance);
    return has_changed;
  }
  const bool has_speed_changed = search_step(noise.speed_step, noise.speed_variance);
  if (!search_step(noise.current_step, noise.current_variance)) return has_speed_changed;
  if (search_step(noise.speed_step, noise.speed_variance))
    search_step(noise.current_step, noise.current_variance);
  return true;
}

}  // namespace morepro::host
