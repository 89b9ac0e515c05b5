#include "sim_host/diagnose/nominal_fit.hpp"

#include <cmath>

namespace morepro::host {
namespace {

constexpr double kSame = 20.0;     // deviance by which two ways to the same fit may differ
constexpr double kHopeless = 0.1;  // deviance per row that no effect makes up for

AxisFit noise_first(AxisFit fit) {
  fit.settle();
  fit.allow_little_noise();
  fit.settle(1);
  return fit;
}

AxisFit parameters_first(AxisFit fit) {
  fit.allow_little_noise();
  fit.refit();
  fit.settle();
  return fit;
}

}  // namespace

std::vector<AxisFit> nominal_fits(const AxisFit& start) {
  AxisFit best = noise_first(start);
  AxisFit other = parameters_first(start);
  if (other.unlikeliness() < best.unlikeliness()) std::swap(best, other);
  const double worse = other.unlikeliness() - best.unlikeliness();
  const double hopeless = kHopeless * static_cast<double>(start.signals().rows);
  if (worse > kSame && worse < hopeless) return {std::move(best), std::move(other)};
  return {std::move(best)};
}

}  // namespace morepro::host
