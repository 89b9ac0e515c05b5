#pragma once
#include <cstdint>
#include <random>

namespace morepro::host {

/// A well mixed 64-bit value of a seed and a counter: the same on every machine.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t counter);

/// +1 or -1, drawn anew every `dwell_s`; a function of time, without memory.
double binary_signal(std::uint64_t seed, double time_s, double dwell_s);

/// Standard normal numbers. The distributions of the C++ library differ between its makers, this does not.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : engine_(seed) {}
  double next();

 private:
  double uniform();  ///< in (-1, 1)

  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace morepro::host
