#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/estimation/feed_filter.hpp"
#include "lib/estimation/spindle_signals.hpp"
#include "lib/frame/sensor_frame.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro {

/// The inputs that hold from the last frame to the present one. A missing input keeps its last value; one
/// that was never recorded has the machine's own value (engagement, temperature, chip load), no contact, or
/// is unknown (voltage, force).
class HeldInputs {
 public:
  explicit HeldInputs(const MachineParameters& machine) {
    value_[index_of(Channel::kEngagement)] = static_cast<float>(machine.feed.engagement);
    value_[index_of(Channel::kToolTemperature)] = static_cast<float>(machine.thermal.tool_degc);
    value_[index_of(Channel::kChipLoad)] = static_cast<float>(machine.tool.chip_load_mm);
  }

  void take(const SensorFrame& frame) {
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      if ((frame.present & (1U << i)) != 0) value_[i] = frame.value[i];
    }
    known_ = static_cast<std::uint16_t>(known_ | frame.present);
  }

  [[nodiscard]] bool knows(Channel channel) const { return (known_ & bit_of(channel)) != 0; }
  [[nodiscard]] float get(Channel channel) const { return value_[index_of(channel)]; }
  [[nodiscard]] bool is_in_contact() const { return get(Channel::kContact) > 0.5F; }

  [[nodiscard]] SpindleInput<float> spindle() const {
    return {get(Channel::kArmatureVoltage), is_in_contact() ? 1.0F : 0.0F, get(Channel::kToolTemperature)};
  }
  [[nodiscard]] FeedInput<float> feed() const {
    return {get(Channel::kFeedForce), is_in_contact() ? 1.0F : 0.0F, get(Channel::kEngagement)};
  }

 private:
  std::array<float, kChannelCount> value_{};
  std::uint16_t known_ = 0;
};

}  // namespace morepro
