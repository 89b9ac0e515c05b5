#pragma once
#include <optional>
#include <span>

#include "sim_host/diagnose/axis_fit.hpp"
#include "sim_host/diagnose/sampling_checks.hpp"

namespace morepro::host {

/// Instants of sampling that are not where the time stamps say: what a fitted model leaves is noisier the
/// faster a signal changes. One jitter for all sensors of all axes. Nothing where neighbouring residuals go
/// together: then a law is wrong and not the clock.
std::optional<SamplingFault> find_jitter(std::span<const AxisFit* const> fits);

}  // namespace morepro::host
