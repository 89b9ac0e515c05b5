#include "sim_host/diagnose/leftover/driven_states.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace morepro::host {
namespace {

constexpr double kShortestLagS = 0.5e-3;
constexpr double kDampingRatio = 0.05;  // broad enough for what lies between two frequencies

}  // namespace

DrivenStates::DrivenStates(const std::vector<float>& values, double rate_hz, std::size_t rows_per_mean,
                           std::span<const double> frequencies_hz)
    : values_(&values),
      rows_per_mean_(rows_per_mean),
      state_(Eigen::ArrayXcd::Zero(kLags + static_cast<Eigen::Index>(frequencies_hz.size()))),
      factor_(state_.size()) {
  const double step_s = static_cast<double>(rows_per_mean) / rate_hz;
  for (Eigen::Index i = 0; i < kLags; ++i)
    factor_(i) = std::exp(-step_s / (kShortestLagS * std::exp2(static_cast<double>(i))));
  for (Eigen::Index i = kLags; i < state_.size(); ++i) {
    const double rate = 2.0 * std::numbers::pi * frequencies_hz[static_cast<std::size_t>(i - kLags)];
    const double damped = rate * std::sqrt(1.0 - kDampingRatio * kDampingRatio);
    factor_(i) = std::exp(std::complex<double>(-kDampingRatio * rate, damped) * step_s);
  }
}

void DrivenStates::move_to(std::size_t mean) {
  const double before = value_;
  for (const std::size_t last = mean * rows_per_mean_; row_ < last; ++row_) {
    const float value = (*values_)[row_];
    if (std::isfinite(value)) value_ = static_cast<double>(value);
  }
  state_ *= factor_;
  // The first value is no change.
  if (!std::isnan(before)) state_ += value_ - before;
}

}  // namespace morepro::host
