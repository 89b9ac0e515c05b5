#include "sim_host/diagnose/fit/white_innovations.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace morepro::host {
namespace {

constexpr double kChanceDeviations = 4.0;  // standard deviations

using PerSensor = std::array<std::vector<float>, kSensorsPerAxis>;

struct Lags {
  std::size_t first = 1;
  std::size_t last = 1;
  std::size_t left_out = 1;  ///< so many of the first ones are not predicted
};

/// From those before, of both sensors.
double predictable_deviance(const PerSensor& white, const Lags& lags) {
  double sum = 0.0;
  double count = 0.0;
  const auto add = [&](const std::vector<float>& now, const std::vector<float>& before, std::size_t lag) {
    if (now.size() != before.size() || now.size() <= lags.left_out) return;
    const auto rows = static_cast<Eigen::Index>(now.size() - lags.left_out);
    using Values = Eigen::Map<const Eigen::VectorXf>;
    const Values a(now.data() + lags.left_out, rows);
    const Values b(before.data() + lags.left_out - lag, rows);
    const double power = static_cast<double>(a.squaredNorm()) * static_cast<double>(b.squaredNorm());
    if (!(power > 0.0)) return;
    const double product = static_cast<double>(a.dot(b));
    sum += static_cast<double>(rows) * product * product / power;
    count += 1.0;
  };
  for (std::size_t lag = lags.first; lag <= lags.last; ++lag)
    for (const auto& now : white)
      for (const auto& before : white) add(now, before, lag);
  // Each is a chi-square of one degree of freedom by chance.
  return std::max(0.0, sum - count - kChanceDeviations * std::sqrt(2.0 * count));
}

std::vector<float> means_of(std::span<const float> values, std::size_t rows) {
  std::vector<float> means;
  for (std::size_t first = 0; first + rows <= values.size(); first += rows) {
    const auto piece = values.subspan(first, rows);
    means.push_back(std::accumulate(piece.begin(), piece.end(), 0.0F) / static_cast<float>(rows));
  }
  return means;
}

PerSensor whitened(const GapStatistics& statistics) {
  const Whitening whitening = whitening_of(statistics);
  PerSensor white;
  for (std::size_t i = 0; i < kSensorsPerAxis; ++i) white[i] = white_innovations(statistics, i, whitening[i]);
  return white;
}

}  // namespace

std::vector<float> white_innovations(const GapStatistics& statistics, std::size_t sensor,
                                     const SensorWhitening& whitening) {
  const auto& raw = statistics.normalised[sensor];
  std::vector<float> scaled(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i)
    scaled[i] = raw[i] / static_cast<float>(whitening.scale[statistics.in_contact[sensor][i] ? 1 : 0]);
  const double per_left = 1.0 / std::sqrt(whitening.left);
  std::vector<float> values(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    double value = static_cast<double>(scaled[i]);
    for (std::size_t j = 0; j < SensorWhitening::kLags.size(); ++j) {
      const std::size_t lag = SensorWhitening::kLags[j];
      if (i >= lag) value -= whitening.memory[j] * static_cast<double>(scaled[i - lag]);
    }
    values[i] = static_cast<float>(per_left * value);
  }
  return values;
}

double predictable_deviance(const GapStatistics& statistics) {
  constexpr std::size_t kLags = SensorWhitening::kLags.back();
  return predictable_deviance(whitened(statistics), {.last = kLags, .left_out = 2 * kLags});
}

double slowly_predictable_deviance(const GapStatistics& statistics, std::size_t rows, std::size_t first) {
  PerSensor means = whitened(statistics);
  for (std::vector<float>& values : means) values = means_of(values, rows);
  const std::size_t last = first + 2;
  return predictable_deviance(means, {.first = first, .last = last, .left_out = last});
}

}  // namespace morepro::host
