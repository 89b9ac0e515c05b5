#include "sim_host/simulate/random_numbers.hpp"

#include <cmath>

namespace morepro::host {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t z = seed + (counter + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

double binary_signal(std::uint64_t seed, double time_s, double dwell_s) {
  // A sample at k h = n dwell belongs to the new interval even where the division rounds down.
  const auto interval = static_cast<std::uint64_t>(time_s / dwell_s + 1.0e-6);
  return (mixed(seed, interval) & 1U) != 0 ? 1.0 : -1.0;
}

double NormalNumbers::uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-52 - 1.0 + 0x1p-53; }

// Marsaglia's polar method: logarithm and square root only.
double NormalNumbers::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0.0;
  double v = 0.0;
  double s = 0.0;
  do {
    u = uniform();
    v = uniform();
    s = u * u + v * v;
  } while (!(s > 0.0 && s < 1.0));
  const double scale = std::sqrt(-2.0 * std::log(s) / s);
  spare_ = v * scale;
  has_spare_ = true;
  return u * scale;
}

}  // namespace morepro::host
