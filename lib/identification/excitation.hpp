#pragma once
#include <cstdint>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Does a signal still move? It rests when it has stayed within `kBand` standard deviations of its own slow
/// mean for as many frames as the mean remembers. At rest a filter learns nothing more, and its linearisation
/// errors along the directions that it cannot see would add up to a false certainty.
template <class Real>
class RestDetector {
 public:
  /// One frame: the measured value and its standard deviation.
  void step(Real value, Real standard_deviation) {
    const Real distance = value - mean_;
    mean_ += distance * Real(1.0 / kMemory);
    if (math::abs(distance) > Real(kBand) * standard_deviation)
      frames_inside_ = 0;
    else if (frames_inside_ < kMemory)
      ++frames_inside_;
  }

  [[nodiscard]] bool is_at_rest() const { return frames_inside_ >= kMemory; }

 private:
  static constexpr std::uint32_t kMemory = 256;
  static constexpr double kBand = 6.0;

  Real mean_{};
  std::uint32_t frames_inside_ = 0;
};

}  // namespace morepro
