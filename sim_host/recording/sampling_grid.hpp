#pragma once
#include <cstdint>
#include <span>

namespace morepro::host {

/// Sampling rate of times that hold gaps and jitter, in Hz, to five digits. `period_s`: what it is near to.
/// The times increase; there are at least two.
double refined_rate_hz(std::span<const double> times_s, double period_s);

/// The regular instants that sampled times scatter around. It follows the times slowly: jitter of nearly half
/// a step is no missing row, and a rate that is wrong in the fifth digit does not add up.
class SamplingGrid {
 public:
  SamplingGrid() = default;
  /// `times_s`: the first rows, at least one.
  SamplingGrid(std::span<const double> times_s, double rate_hz);

  /// Steps from the row before, at least 1. The first time of the constructor is the row before the first.
  std::int64_t steps_to(double time_s);

 private:
  double rate_hz_ = 0.0;
  double instant_s_ = 0.0;
};

}  // namespace morepro::host
