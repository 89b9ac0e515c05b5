#include "sim_host/diagnose/fit/whitening.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace morepro::host {
namespace {

constexpr std::size_t kFewestToWhiten = 400;  // for nine coefficients and two scales
constexpr float kLargestNormalised = 6.0F;
constexpr double kFarFrom = 0.5;      // of what is measured, a share
constexpr double kNegligible = 0.02;  // of a memory: costs more than it whitens

/// Free and in contact. A state that is seldom has no scale of its own, and counts: its rows may be those
/// that a wrong model misses most.
std::array<double, 2> scales_of(std::span<const float> normalised, const std::vector<bool>& in_contact) {
  std::array<double, 2> squares{};
  std::array<std::size_t, 2> count{};
  for (std::size_t i = 0; i < normalised.size(); ++i) {
    const std::size_t state = in_contact[i] ? 1 : 0;
    squares[state] += static_cast<double>(normalised[i]) * static_cast<double>(normalised[i]);
    ++count[state];
  }
  if (count[0] >= kFewestToWhiten && count[1] >= kFewestToWhiten)
    return {std::sqrt(squares[0] / static_cast<double>(count[0])),
            std::sqrt(squares[1] / static_cast<double>(count[1]))};
  const double all = std::sqrt((squares[0] + squares[1]) / static_cast<double>(normalised.size()));
  return {all, all};
}

std::vector<float> scaled(std::span<const float> normalised, const std::vector<bool>& in_contact,
                          const std::array<double, 2>& scale) {
  std::vector<float> values(normalised.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::clamp(normalised[i] / static_cast<float>(scale[in_contact[i] ? 1 : 0]),
                           -kLargestNormalised, kLargestNormalised);
  return values;
}

std::vector<double> autocovariance(std::span<const float> values, std::size_t lags) {
  constexpr std::size_t kBatch = 512;  // in float: 512 products lose nothing that the sum of all would show
  using Values = Eigen::Map<const Eigen::VectorXf>;
  std::vector<double> sums(lags + 1, 0.0);
  for (std::size_t first = lags; first < values.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, values.size() - first);
    const Values now(values.data() + first, static_cast<Eigen::Index>(count));
    for (std::size_t lag = 0; lag <= lags; ++lag)
      sums[lag] += static_cast<double>(now.dot(Values(values.data() + first - lag, now.size())));
  }
  for (double& sum : sums) sum /= static_cast<double>(values.size() - lags);
  return sums;
}

/// Rows without a sample behind which another stretch begins: more than a few of what lies between samples.
std::uint32_t rows_between_stretches(std::span<const std::uint32_t> row) {
  constexpr std::size_t kFewest = 50, kTimes = 3;
  if (row.size() < 2) return kFewest;
  return static_cast<std::uint32_t>(
      std::max(kFewest, kTimes * (row.back() - row.front()) / (row.size() - 1)));
}

/// Share of the squares of values that a memory leaves, of those whose past is in their own stretch. Where a
/// machine runs up at the beginning the covariances that a memory was fitted to leave less of a wrong model
/// than the noise that is new in every row: what they are far from is measured.
double share_left_by(const SensorWhitening& whitening, std::span<const float> values,
                     std::span<const std::uint32_t> row) {
  constexpr auto& kLags = SensorWhitening::kLags;
  const std::uint32_t apart = rows_between_stretches(row);
  double all = 0.0, left = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && !row.empty() && row[i] - row[i - 1] > apart) first = i;
    if (i < first + kLags.back()) continue;
    const auto value = static_cast<double>(values[i]);
    double news = value;
    for (std::size_t k = 0; k < kLags.size(); ++k)
      news -= whitening.memory[k] * static_cast<double>(values[i - kLags[k]]);
    all += value * value;
    left += news * news;
  }
  return left < all ? left / all : 1.0;
}

}  // namespace

SensorWhitening whitening_of(std::span<const float> normalised, const std::vector<bool>& in_contact,
                             std::span<const std::uint32_t> row, bool may_remember) {
  constexpr auto& kLags = SensorWhitening::kLags;
  constexpr auto kCount = static_cast<Eigen::Index>(kLags.size());
  SensorWhitening whitening;
  if (normalised.size() < kFewestToWhiten) return whitening;
  const std::array<double, 2> scale = scales_of(normalised, in_contact);
  if (!(scale[0] > 0.0 && scale[1] > 0.0)) return whitening;
  whitening.scale = scale;
  if (!may_remember) return whitening;
  const auto values = scaled(normalised, in_contact, whitening.scale);
  const auto covariance = autocovariance(values, kLags.back());
  Eigen::MatrixXd a(kCount, kCount);
  Eigen::VectorXd b(kCount);
  for (Eigen::Index i = 0; i < kCount; ++i) {
    const std::size_t lag = kLags[static_cast<std::size_t>(i)];
    b(i) = covariance[lag];
    for (Eigen::Index j = 0; j < kCount; ++j) {
      const std::size_t other = kLags[static_cast<std::size_t>(j)];
      a(i, j) = covariance[lag > other ? lag - other : other - lag];
    }
  }
  a.diagonal().array() += 1.0e-3 * covariance[0];
  Eigen::VectorXd memory = a.ldlt().solve(b);
  memory = (memory.array().abs() < kNegligible).select(0.0, memory);
  for (std::size_t i = 0; i < kLags.size(); ++i) whitening.memory[i] = memory(static_cast<Eigen::Index>(i));
  const double explained = 2.0 * memory.dot(b) - memory.dot(a * memory);
  const double expected = std::max(1.0 - explained / covariance[0], 1.0e-6);
  whitening.left = expected;
  if (expected < kFarFrom) {
    const double measured = share_left_by(whitening, values, row);
    if (expected < kFarFrom * measured) whitening.left = measured;
  }
  return whitening;
}

}  // namespace morepro::host
