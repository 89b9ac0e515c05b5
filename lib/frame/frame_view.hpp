#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "lib/frame/sensor_frame.hpp"

namespace morepro {

/// A frame, and which of its channels may be used. Does not copy the frame, which must outlive it.
struct FrameView {
  const SensorFrame& frame;
  std::uint16_t usable;  ///< bit_of(channel)

  [[nodiscard]] bool has(Channel channel) const { return (usable & bit_of(channel)) != 0; }
  /// The value of a channel that is usable; meaningless otherwise.
  [[nodiscard]] float get(Channel channel) const { return frame.get(channel); }

  /// visit(index, value) for every usable channel; `visit` may take channels away.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t bits = usable; bits != 0; bits &= bits - 1) {
      const auto index = static_cast<std::size_t>(std::countr_zero(bits));
      visit(index, frame.value[index]);
    }
  }
};

}  // namespace morepro
