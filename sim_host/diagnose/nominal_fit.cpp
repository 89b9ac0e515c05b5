#include "sim_host/diagnose/nominal_fit.hpp"

#include <cmath>

#include "sim_host/support/in_parallel.hpp"

namespace morepro::host {
namespace {

constexpr double kSame = 20.0;     // deviance by which two ways to the same fit may differ
constexpr double kHopeless = 0.1;  // deviance per row that no effect makes up for

void noise_first(AxisFit& fit) {
  fit.settle();
  fit.allow_little_noise();
  fit.settle(1);
}

void parameters_first(AxisFit& fit) {
  fit.allow_little_noise();
  fit.refit();
  fit.settle();
}

}  // namespace

std::vector<AxisFit> nominal_fits(const AxisFit& start) {
  AxisFit best = start;
  AxisFit other = start;
  best.narrow_down();
  other.narrow_down();
  in_parallel(2, [&](std::size_t i) { i == 0 ? noise_first(best) : parameters_first(other); });
  if (other.unlikeliness() < best.unlikeliness()) std::swap(best, other);
  const bool are_same = !(other.unlikeliness() - best.unlikeliness() > kSame);
  best.widen();
  other.widen();
  in_parallel(are_same ? 1 : 2, [&](std::size_t i) { (i == 0 ? best : other).polish(); });
  if (are_same) return {std::move(best)};
  if (other.unlikeliness() < best.unlikeliness()) std::swap(best, other);
  const double worse = other.unlikeliness() - best.unlikeliness();
  const double hopeless = kHopeless * static_cast<double>(start.signals().rows);
  if (worse > kSame && worse < hopeless) return {std::move(best), std::move(other)};
  return {std::move(best)};
}

}  // namespace morepro::host
