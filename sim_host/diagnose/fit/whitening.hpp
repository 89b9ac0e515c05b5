#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"

namespace morepro::host {

/// What is left of innovations when the observer's noise is not quite the machine's: another size, in contact
/// too, and a short memory. The weights of the rows follow from it.
struct SensorWhitening {
  static constexpr std::array<std::size_t, 9> kLags{1, 2, 3, 4, 6, 8, 12, 16, 24};

  std::array<double, 2> scale{1.0, 1.0};  ///< standard deviation of normalised innovations: free, in contact
  std::array<double, kLags.size()> memory{};  ///< autoregression of the scaled innovations
  double left = 1.0;                          ///< share of their variance that the memory does not predict
};
using Whitening = std::array<SensorWhitening, kSensorsPerAxis>;

/// Standard deviation of an innovation: what the observer expects, as the whitening has corrected it.
inline double deviation_of(const Whitening& whitening, const Innovation& innovation) {
  return whitening[innovation.sensor].scale[innovation.in_contact ? 1 : 0] * std::sqrt(innovation.variance);
}

/// Estimates the whitening of one sensor from its normalised innovations (value over the observer's standard
/// deviation) in the order of time; `row`: of the recording, of each; empty: they are one stretch. Robust
/// against a few outliers. Too few of them give no whitening.
SensorWhitening whitening_of(std::span<const float> normalised, const std::vector<bool>& in_contact,
                             std::span<const std::uint32_t> row, bool may_remember = true);

}  // namespace morepro::host
