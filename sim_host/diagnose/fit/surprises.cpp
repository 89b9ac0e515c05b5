#include "sim_host/diagnose/fit/surprises.hpp"

#include <algorithm>
#include <cmath>

namespace morepro::host {

Surprises surprises_of(const AxisFit& fit) {
  constexpr double kSurprising = 25.0;  // squared standard deviations: of noise one row in two millions
  Surprises surprises;
  for (const std::vector<float>& normalised : fit.innovations().normalised) {
    double surprising = 0.0;
    double power = 0.0;
    for (const float value : normalised) {
      const double square = static_cast<double>(value) * static_cast<double>(value);
      power += square;
      if (square > kSurprising) surprising += 1.0;
    }
    const auto rows = static_cast<double>(normalised.size());
    if (!(rows > 0.0) || !(surprising / rows > surprises.share)) continue;
    surprises = {surprising / rows, rows * std::log(std::max(power / rows, 1.0))};
  }
  return surprises;
}

}  // namespace morepro::host
