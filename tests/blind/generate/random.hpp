#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace blind {

/// A small generator whose numbers are the same with every compiler and library.
class Random {
 public:
  /// Streams of one seed are independent of each other: a run without the effect sees the noise of the run
  /// with it.
  Random(std::uint64_t seed, std::uint64_t stream)
      : state_(seed * 0x9E3779B97F4A7C15ULL + stream * 0xD1B54A32D192ED03ULL) {
    for (int warm_up = 0; warm_up < 4; ++warm_up) bits();
  }

  std::uint64_t bits() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  bool chance(double probability) { return uniform() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  int pick(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }

  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// Unit variance, nearly Gaussian, one word of randomness: enough for noise that is filtered anyway.
  double quick_normal() {
    const std::uint64_t word = bits();
    const std::uint64_t sum =
        (word & 0xFFFF) + ((word >> 16) & 0xFFFF) + ((word >> 32) & 0xFFFF) + (word >> 48);
    return (static_cast<double>(sum) - 131070.0) / 37837.0;
  }

 private:
  std::uint64_t state_;
};

}  // namespace blind
