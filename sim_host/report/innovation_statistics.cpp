#include "sim_host/report/innovation_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace morepro::host {
namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Hann, of unit mean square.
const std::vector<double>& taper() {
  static const std::vector<double> weights = [] {
    std::vector<double> w(InnovationStatistics::kSegment);
    const double step = 2.0 * std::numbers::pi / static_cast<double>(w.size());
    for (std::size_t i = 0; i < w.size(); ++i)
      w[i] = std::sqrt(8.0 / 3.0) * 0.5 * (1.0 - std::cos(step * static_cast<double>(i)));
    return w;
  }();
  return weights;
}

}  // namespace

void InnovationStatistics::take(double normalised) {
  if (!std::isfinite(normalised)) {
    segment_.clear();
    return;
  }
  segment_.push_back(normalised);
  if (segment_.size() == kSegment) finish_segment();
}

void InnovationStatistics::finish_segment() {
  thread_local Eigen::FFT<double> transform;
  for (std::size_t i = 0; i < kSegment; ++i)
    for (std::size_t lag = 0; lag <= std::min(i, kLags); ++lag)
      product_[lag] += segment_[i] * segment_[i - lag];
  for (std::size_t i = 0; i < kSegment; ++i) segment_[i] *= taper()[i];
  Spectrum spectrum;
  transform.fwd(spectrum, segment_);
  power_.resize(kSegment / 2 + 1, 0.0);
  for (std::size_t k = 0; k < power_.size(); ++k)
    power_[k] += std::norm(spectrum[k]) / static_cast<double>(kSegment);
  ++segments_;
  segment_.clear();
}

std::vector<double> InnovationStatistics::spectrum() const {
  std::vector<double> mean = power_;
  for (double& power : mean) power /= static_cast<double>(segments_);
  return mean;
}

std::vector<double> InnovationStatistics::autocorrelation() const {
  std::vector<double> values;
  if (segments_ == 0 || !(product_[0] > 0.0)) return values;
  for (std::size_t lag = 0; lag <= kLags; ++lag) {
    const double share = static_cast<double>(kSegment) / static_cast<double>(kSegment - lag);
    values.push_back(share * product_[lag] / product_[0]);
  }
  return values;
}

double InnovationStatistics::bound() const {
  return kTwoSided95 / std::sqrt(static_cast<double>(std::max<std::size_t>(segments_, 1) * kSegment));
}

double NisWindow::bound() { return kTwoSided95 * std::sqrt(2.0 / static_cast<double>(kInnovations)); }

void NisWindow::take(double normalised) {
  sum_ += normalised * normalised;
  if (++count_ < kInnovations) return;
  value_ = sum_ / static_cast<double>(count_);
  sum_ = 0.0;
  count_ = 0;
}

}  // namespace morepro::host
