#include "sim_host/diagnose/leftover/spectral_lines.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace morepro::host {
namespace {

constexpr std::size_t kMostLines = 6;
constexpr std::ptrdiff_t kFewestKnown = 256;

/// Is it no more than what a line between two frequencies leaves in those around it?
bool is_beside(const SpectralLine& stronger, const SpectralLine& line, double per_cycle) {
  constexpr double kNext = 2.5;
  const double away = std::fabs(stronger.cycles_per_sample - line.cycles_per_sample) * per_cycle;
  return away < kNext || line.power * away * away < stronger.power;
}

}  // namespace

SpectralLines find_lines(std::span<const float> white) {
  SpectralLines found;
  const auto is_known = [](float value) { return value != 0.0F; };
  if (std::count_if(white.begin(), white.end(), is_known) < kFewestKnown) return found;
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
  found.noise = mean;
  // The largest of n exponential variables is ln n on average; e^-12 of all sequences reach 12 more.
  const double chance = std::log(found.noise_bins) + 12.0;
  const auto end_of_strong =
      std::partition(lines.begin(), lines.end(),
                     [least = chance * mean](const SpectralLine& line) { return line.power > least; });
  lines.erase(end_of_strong, lines.end());
  std::sort(lines.begin(), lines.end(), is_stronger);
  for (std::size_t i = 0; i < lines.size() && found.lines.size() < kMostLines; ++i) {
    const SpectralLine line{lines[i].cycles_per_sample, lines[i].power / mean};
    if (i < kMostLines) found.gain += 2.0 * line.power * static_cast<double>(white.size()) / all;
    const auto hides = [&](const SpectralLine& other) { return is_beside(other, line, all); };
    if (std::none_of(found.lines.begin(), found.lines.end(), hides)) found.lines.push_back(line);
  }
  return found;
}

}  // namespace morepro::host
