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

SpectralLines find_lines(std::span<const float> white) {
  SpectralLines found;
  if (white.size() < kFewest) return found;
  std::size_t length = 1;
  while (2 * length <= white.size()) length *= 2;
  std::vector<float> part(white.begin(), white.begin() + static_cast<std::ptrdiff_t>(length));
  Eigen::FFT<float> transform;
  std::vector<std::complex<float>> spectrum;
  transform.fwd(spectrum, part);
  const auto all = static_cast<double>(length);
  found.resolution = 1.0 / all;
  std::vector<SpectralLine> lines;
  for (std::size_t k = 2; k < length / 2; ++k)
    lines.push_back({static_cast<double>(k) / all, static_cast<double>(std::norm(spectrum[k])) / all});
  found.noise_bins = static_cast<double>(lines.size());
  // Of an exponential variable the median is ln 2 of the mean, and lines do not move it.
  const auto is_stronger = [](const SpectralLine& a, const SpectralLine& b) { return a.power > b.power; };
  const auto middle = lines.begin() + static_cast<std::ptrdiff_t>(lines.size() / 2);
  std::nth_element(lines.begin(), middle, lines.end(), is_stronger);
  const double mean = middle->power / std::numbers::ln2;
  // The largest of n exponential variables is ln n on average; e^-12 of all sequences reach 12 more.
  const double chance = std::log(found.noise_bins) + 12.0;
  const std::size_t most = std::min(kMostLines, lines.size());
  std::partial_sort(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(most), lines.end(),
                    is_stronger);
  for (std::size_t i = 0; i < most; ++i) {
    const double power = lines[i].power / mean;
    if (!(lines[i].power > chance * mean)) break;
    found.lines.push_back({lines[i].cycles_per_sample, power});
    found.gain += 2.0 * power * static_cast<double>(white.size()) / all;
  }
  return found;
}

}  // namespace morepro::host
