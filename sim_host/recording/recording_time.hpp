#pragma once
#include <cstdint>

namespace morepro::host {

/// Microseconds of a longer time do not fit 64 bits with room to spare.
inline constexpr double kLongestTimeS = 9.0e12;

/// Microseconds of a time in seconds, shorter than kLongestTimeS.
std::int64_t microseconds(double time_s);

inline double seconds(std::int64_t time_us) { return static_cast<double>(time_us) / 1.0e6; }

/// As a frame holds them.
constexpr std::uint32_t wrapped(std::int64_t time_us) { return static_cast<std::uint32_t>(time_us); }

/// The whole time of a frame, at most 35 minutes before or after `near_us`.
constexpr std::int64_t unwrapped(std::uint32_t time_us, std::int64_t near_us) {
  return near_us + static_cast<std::int32_t>(time_us - wrapped(near_us));
}

/// The whole times of frames that follow each other, for formats whose time must increase.
class IncreasingTime {
 public:
  /// `start_us`: of the first frame.
  explicit IncreasingTime(std::int64_t start_us) : time_us_(start_us) {}

  /// Returns false, and changes nothing, where the frame's time is not after the one before.
  bool advance(std::uint32_t frame_time_us) {
    const std::int64_t time_us = unwrapped(frame_time_us, time_us_);
    if (!is_first_ && time_us <= time_us_) return false;
    time_us_ = time_us;
    is_first_ = false;
    return true;
  }

  [[nodiscard]] std::int64_t us() const { return time_us_; }

 private:
  std::int64_t time_us_;
  bool is_first_ = true;
};

}  // namespace morepro::host
