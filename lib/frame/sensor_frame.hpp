#pragma once
#include <array>
#include <cstdint>

#include "lib/frame/channel.hpp"

namespace morepro {

/// One sample of every recorded channel: what a board measures and what a recording holds.
struct SensorFrame {
  std::uint32_t sequence = 0;  ///< +1 per frame, wraps
  std::uint32_t time_us = 0;   ///< microseconds since an arbitrary start, wraps after 71.6 minutes
  std::uint16_t present = 0;   ///< bit_of(channel) set: value[channel] was measured
  std::array<float, kChannelCount> value{};

  [[nodiscard]] bool has(Channel channel) const { return (present & bit_of(channel)) != 0; }
  [[nodiscard]] float get(Channel channel) const { return value[index_of(channel)]; }
  void set(Channel channel, float v) {
    value[index_of(channel)] = v;
    present = static_cast<std::uint16_t>(present | bit_of(channel));
  }
  void clear(Channel channel) { present = static_cast<std::uint16_t>(present & ~bit_of(channel)); }
};

}  // namespace morepro
