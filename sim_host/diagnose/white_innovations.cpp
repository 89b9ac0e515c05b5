#include "sim_host/diagnose/white_innovations.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace morepro::host {
namespace {

constexpr double kChanceDeviations = 4.0;  // standard deviations

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
  const Whitening whitening = whitening_of(statistics);
  std::array<std::vector<float>, kSensorsPerAxis> white;
  for (std::size_t i = 0; i < kSensorsPerAxis; ++i) white[i] = white_innovations(statistics, i, whitening[i]);
  double sum = 0.0;
  double count = 0.0;
  const auto add = [&](const std::vector<float>& now, const std::vector<float>& before, std::size_t lag) {
    if (now.size() != before.size() || now.size() <= 2 * kLags) return;
    const auto rows = static_cast<Eigen::Index>(now.size() - 2 * kLags);
    using Values = Eigen::Map<const Eigen::VectorXf>;
    const Values a(now.data() + 2 * kLags, rows);
    const Values b(before.data() + 2 * kLags - lag, rows);
    const double power = static_cast<double>(a.squaredNorm()) * static_cast<double>(b.squaredNorm());
    if (!(power > 0.0)) return;
    const double product = static_cast<double>(a.dot(b));
    sum += static_cast<double>(rows) * product * product / power;
    count += 1.0;
  };
  for (std::size_t lag = 1; lag <= kLags; ++lag)
    for (const auto& now : white)
      for (const auto& before : white) add(now, before, lag);
  // Each is a chi-square of one degree of freedom by chance.
  return std::max(0.0, sum - count - kChanceDeviations * std::sqrt(2.0 * count));
}

}  // namespace morepro::host
