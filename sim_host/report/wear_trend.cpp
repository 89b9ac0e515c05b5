#include "sim_host/report/wear_trend.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {
namespace {

constexpr std::size_t kFewestTrendBlocks = 16;
/// What is left of a smooth curve is one long wander; it counts as so many independent values at least.
constexpr double kFewestIndependent = 4.0;

/// Standard error of a slope from what is left of its line, whose values are like their neighbours; `spread`:
/// sum of squares of the times about their mean.
double error_of(const std::vector<double>& left, double spread) {
  const auto n = static_cast<double>(left.size());
  double square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    square += left[i] * left[i];
    if (i > 0) product += left[i] * left[i - 1];
  }
  if (!(square > 0.0)) return 0.0;
  const double seen = product / square;
  // A line that was fitted takes some of the likeness away: about (2 + 4 r) / n of it.
  const double likeness = std::clamp(seen + (2.0 + 4.0 * std::fmax(seen, 0.0)) / n, 0.0, 0.999);
  const double alike = std::fmin((1.0 + likeness) / (1.0 - likeness), n / kFewestIndependent);
  return std::sqrt(square / (n / alike - 2.0) / spread * alike);
}

}  // namespace

void WearTrend::take(double time_s, double wear) {
  if (!std::isfinite(wear)) return;
  sum_.time_s += time_s;
  sum_.wear += wear;
  if (++count_ == block_samples_) close();
}

void WearTrend::close() {
  const auto n = static_cast<double>(count_);
  blocks_.push_back({sum_.time_s / n, sum_.wear / n});
  sum_ = {};
  count_ = 0;
  if (blocks_.size() < kMostBlocks) return;
  for (std::size_t i = 0; i < kMostBlocks / 2; ++i) {
    const Block &one = blocks_[2 * i], &other = blocks_[2 * i + 1];
    blocks_[i] = {0.5 * (one.time_s + other.time_s), 0.5 * (one.wear + other.wear)};
  }
  blocks_.resize(kMostBlocks / 2);
  block_samples_ *= 2;
}

std::optional<TrendLine> WearTrend::line() const {
  if (blocks_.size() < kFewestTrendBlocks) return std::nullopt;
  const auto n = static_cast<double>(blocks_.size());
  Block mean;
  for (const Block& block : blocks_) {
    mean.time_s += block.time_s / n;
    mean.wear += block.wear / n;
  }
  double spread = 0.0, common = 0.0;
  for (const Block& block : blocks_) {
    spread += (block.time_s - mean.time_s) * (block.time_s - mean.time_s);
    common += (block.time_s - mean.time_s) * (block.wear - mean.wear);
  }
  const double slope = common / spread;
  std::vector<double> left;
  for (const Block& block : blocks_)
    left.push_back(block.wear - mean.wear - slope * (block.time_s - mean.time_s));
  const double from_s = blocks_.front().time_s;
  return TrendLine{.from_s = from_s,
                   .to_s = blocks_.back().time_s,
                   .at_from = mean.wear + slope * (from_s - mean.time_s),
                   .slope_per_s = slope,
                   .standard_error_per_s = error_of(left, spread)};
}

}  // namespace morepro::host
