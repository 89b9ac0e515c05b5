#include "sim_host/diagnose/white_innovations.hpp"

#include <cmath>

namespace morepro::host {

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

}  // namespace morepro::host
