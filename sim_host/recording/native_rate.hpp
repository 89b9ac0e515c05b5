#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/frame/sensor_frame.hpp"

namespace morepro::host {

/// Sampling rate of a stream of frames, from the first 10,000 steps between them.
class NativeRate {
 public:
  void add(const SensorFrame& frame);

  /// In Hz; 0 where fewer than two frames followed each other.
  [[nodiscard]] double rate_hz() const;

 private:
  static constexpr std::size_t kSteps = 10000;

  std::vector<double> steps_us_;
  SensorFrame previous_;
  bool has_previous_ = false;
};

}  // namespace morepro::host
