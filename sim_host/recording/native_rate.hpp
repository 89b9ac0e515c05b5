#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace morepro::host {

/// Sampling rate of a stream of frames, from the first 10,000 steps between them.
class NativeRate {
 public:
  /// Of the next frame; time in microseconds. Both wrap.
  void add(std::uint32_t sequence, std::uint32_t time_us);

  /// In Hz; 0 where fewer than two frames followed each other.
  [[nodiscard]] double rate_hz() const;

 private:
  static constexpr std::size_t kSteps = 10000;

  std::vector<double> steps_us_;
  std::uint32_t previous_sequence_ = 0;
  std::uint32_t previous_time_us_ = 0;
  bool has_previous_ = false;
};

}  // namespace morepro::host
