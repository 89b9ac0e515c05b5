#pragma once
#include <cstdint>

namespace morepro {

/// Rejects single measurements that no parameters within the filter's own uncertainty explain, and notices
/// when it is the state that is wrong. The covariance takes a rejected one for knowledge: one frame's worth.
template <class Real>
class OutlierGate {
 public:
  static constexpr double kLargest = 64.0;  ///< normalised innovation squared
  static constexpr std::uint8_t kPatience = 5;

  /// One frame with its largest normalised innovation squared.
  void step(Real largest) {
    if (!(largest > Real(kLargest)))
      rejected_ = 0;
    else if (rejected_ < kPatience)
      ++rejected_;
  }
  /// That many frames in a row: the state must start again from the measurement.
  [[nodiscard]] bool has_lost_the_state() const { return rejected_ >= kPatience; }
  void restart() { rejected_ = 0; }

 private:
  std::uint8_t rejected_ = 0;
};

}  // namespace morepro
