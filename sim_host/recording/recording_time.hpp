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

}  // namespace morepro::host
