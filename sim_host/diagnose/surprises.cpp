#include "sim_host/diagnose/surprises.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim_host/diagnose/innovation_pass.hpp"

namespace morepro::host {

Surprises surprises_of(const AxisFit& fit) {
  constexpr double kSurprising = 25.0;  // squared standard deviations: of noise one row in two millions
  struct Sum {
    double rows = 0.0;
    double surprising = 0.0;
    double power = 0.0;
  };
  std::array<Sum, kSensorsPerAxis> sums;
  run_observer(fit.axis(), fit.signals(), fit.model(), 0, fit.signals().rows, [&](const Innovation& v) {
    const double power = v.value * v.value / v.variance;
    Sum& sum = sums[v.sensor];
    sum.rows += 1.0;
    sum.power += power;
    if (power > kSurprising) sum.surprising += 1.0;
  });
  Surprises surprises;
  for (const Sum& sum : sums) {
    if (!(sum.rows > 0.0) || !(sum.surprising / sum.rows > surprises.share)) continue;
    surprises = {sum.surprising / sum.rows, sum.rows * std::log(std::max(sum.power / sum.rows, 1.0))};
  }
  return surprises;
}

}  // namespace morepro::host
