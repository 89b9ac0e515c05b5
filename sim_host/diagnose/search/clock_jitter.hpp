#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// What a fitted model leaves is noisier the faster a signal changes.
struct Shaking {
  /// Instants of sampling that are not where the time stamps say: one jitter for all sensors of all axes.
  std::optional<SamplingFault> of_clock{};
  /// Deviance of one sensor, where neighbouring residuals go together, or another sensor says that the clock
  /// is right: then a law is wrong. No noise knows how fast something changes.
  double of_law = 0.0;
  std::size_t fit = 0;     ///< whose sensor
  std::size_t sensor = 0;  ///< of the axis
};

Shaking find_shaking(std::span<const AxisFit* const> fits);

}  // namespace morepro::host
