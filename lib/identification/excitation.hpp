#pragma once
#include <cstdint>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Does a signal still move? It rests when it has stayed within `kBand` standard deviations of its own slow
/// mean for as many frames as the mean remembers. At rest a filter learns nothing more, and its linearisation
/// errors along the directions that it cannot see would add up to a false certainty.
///
/// The standard deviation is the sensor's or that of the signal's own jitter, whichever is larger: a
/// controller that answers to measurement noise moves its output in every frame and excites nothing. The
/// jitter is the median of the steps between two frames, so that the edges of an excitation do not count as
/// jitter.
template <class Real>
class RestDetector {
 public:
  /// Moves until it is seen to rest.
  RestDetector() = default;
  /// Rests at a value until it is seen to move.
  explicit RestDetector(Real resting_at) : last_(resting_at), mean_(resting_at), frames_inside_(kMemory) {}

  /// One frame: the value and the standard deviation of its sensor, > 0.
  void step(Real value, Real standard_deviation) {
    follow_median_step(math::abs(value - last_), standard_deviation);
    last_ = value;
    const Real distance = value - mean_;
    mean_ += distance * Real(1.0 / kMemory);
    const Real jitter = Real(kPerMedianStep) * median_step_;
    const Real deviation = jitter > standard_deviation ? jitter : standard_deviation;
    if (math::abs(distance) > Real(kBand) * deviation)
      frames_inside_ = 0;
    else if (frames_inside_ < kMemory)
      ++frames_inside_;
  }

  [[nodiscard]] bool is_at_rest() const { return frames_inside_ >= kMemory; }

 private:
  static constexpr std::uint32_t kMemory = 256;
  static constexpr double kBand = 6.0;
  static constexpr double kPerMedianStep = 1.05;  // of white noise: 1/(0.6745 sqrt 2)
  static constexpr double kRate = 1.0 / 64.0;

  /// Up by a little when the step is larger, down by as much when it is smaller: settles at the median.
  void follow_median_step(Real size, Real smallest) {
    median_step_ *= size > median_step_ ? Real(1.0 + kRate) : Real(1.0 - kRate);
    const Real floor = Real(0.1) * smallest;
    if (!(median_step_ > floor)) median_step_ = floor;
  }

  Real last_{};
  Real mean_{};
  Real median_step_{};
  std::uint32_t frames_inside_ = 0;
};

}  // namespace morepro
