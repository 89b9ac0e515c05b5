#include "sim_host/diagnose/spectral_lines.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace morepro::host {
namespace {

constexpr std::size_t kMostLines = 6;
constexpr std::size_t kFewest = 256;

}  // namespace

double line_gain(std::span<const float> white) {
  if (white.size() < kFewest) return 0.0;
  std::size_t length = 1;
  while (2 * length <= white.size()) length *= 2;
  std::vector<float> part(white.begin(), white.begin() + static_cast<std::ptrdiff_t>(length));
  Eigen::FFT<float> transform;
  std::vector<std::complex<float>> spectrum;
  transform.fwd(spectrum, part);
  std::vector<double> power;
  for (std::size_t k = 2; k < length / 2; ++k)
    power.push_back(static_cast<double>(std::norm(spectrum[k])) / static_cast<double>(length));
  // Of an exponential variable the median is ln 2 of the mean, and lines do not move it.
  const auto middle = power.begin() + static_cast<std::ptrdiff_t>(power.size() / 2);
  std::nth_element(power.begin(), middle, power.end());
  const double mean = *middle / std::numbers::ln2;
  // The largest of n exponential variables is ln n on average; e^-12 of all sequences reach 12 more.
  const double chance = std::log(static_cast<double>(power.size())) + 12.0;
  const auto lines = static_cast<std::ptrdiff_t>(std::min(kMostLines, power.size()));
  std::partial_sort(power.begin(), power.begin() + lines, power.end(), std::greater<>());
  double gain = 0.0;
  for (std::ptrdiff_t i = 0; i < lines; ++i)
    if (power[static_cast<std::size_t>(i)] > chance * mean)
      gain += 2.0 * power[static_cast<std::size_t>(i)] / mean;
  return gain * static_cast<double>(white.size()) / static_cast<double>(length);
}

}  // namespace morepro::host
