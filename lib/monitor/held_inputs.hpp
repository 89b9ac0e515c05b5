#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/estimation/feed_filter.hpp"
#include "lib/estimation/spindle_signals.hpp"
#include "lib/frame/frame_view.hpp"
#include "lib/monitor/winding_warming.hpp"
#include "lib/plant/contact_law.hpp"
#include "lib/plant/machine_parameters.hpp"
#include "lib/plant/plant_state.hpp"

namespace morepro {

/// The inputs that hold from the last frame to the present one. A missing input keeps its last value; one
/// that was never recorded has the machine's own value (engagement, temperature, chip load), no contact, or
/// is unknown (voltage, force).
class HeldInputs {
 public:
  /// rate_hz > 0: of the frames.
  HeldInputs(const MachineParameters& machine, double rate_hz)
      : law_(machine), warming_(machine.spindle, rate_hz) {
    value_[index_of(Channel::kWindingTemperature)] = warming_.winding_degc();
    value_[index_of(Channel::kEngagement)] = static_cast<float>(machine.feed.engagement);
    value_[index_of(Channel::kToolTemperature)] = static_cast<float>(machine.thermal.tool_degc);
    value_[index_of(Channel::kChipLoad)] = static_cast<float>(machine.tool.chip_load_mm);
    thermal_factor_ = law_.thermal_factor(get(Channel::kToolTemperature));
  }

  void take(const FrameView& frame) {
    const float temperature_degc = get(Channel::kToolTemperature);
    if (!knows(Channel::kWindingTemperature)) warm_winding();
    frame.for_each([this](std::size_t i, float value) { value_[i] = value; });
    known_ = static_cast<std::uint16_t>(known_ | frame.usable);
    if (!(get(Channel::kToolTemperature) == temperature_degc))
      thermal_factor_ = law_.thermal_factor(get(Channel::kToolTemperature));
  }

  /// bit_of(channel) of every channel that was ever usable.
  [[nodiscard]] std::uint16_t known() const { return known_; }
  [[nodiscard]] bool knows(Channel channel) const { return (known_ & bit_of(channel)) != 0; }
  [[nodiscard]] float get(Channel channel) const { return value_[index_of(channel)]; }
  [[nodiscard]] bool is_in_contact() const { return get(Channel::kContact) > 0.5F; }

  /// Another voltage and force hold until the next ones are recorded.
  void drive(float voltage_v, float force_n) {
    value_[index_of(Channel::kArmatureVoltage)] = voltage_v;
    value_[index_of(Channel::kFeedForce)] = force_n;
  }

  [[nodiscard]] SpindleInput<float> spindle() const {
    return {get(Channel::kArmatureVoltage), is_in_contact() ? 1.0F : 0.0F, thermal_factor_};
  }
  [[nodiscard]] FeedInput<float> feed() const {
    return {get(Channel::kFeedForce), is_in_contact() ? 1.0F : 0.0F, get(Channel::kEngagement)};
  }
  [[nodiscard]] PlantInput<float> plant() const {
    return {get(Channel::kArmatureVoltage), get(Channel::kFeedForce), contact(),
            get(Channel::kEngagement),      get(Channel::kChipLoad),  get(Channel::kToolTemperature)};
  }
  /// 0 or 1.
  [[nodiscard]] float contact() const { return is_in_contact() ? 1.0F : 0.0F; }
  /// Measured, or as the current has warmed it.
  [[nodiscard]] float winding_degc() const { return get(Channel::kWindingTemperature); }

 private:
  /// By the current that has held until now.
  void warm_winding() {
    warming_.step(get(Channel::kArmatureCurrent));
    value_[index_of(Channel::kWindingTemperature)] = warming_.winding_degc();
  }

  std::array<float, kChannelCount> value_{};
  std::uint16_t known_ = 0;
  ContactLaw<float> law_;
  WindingWarming warming_;
  float thermal_factor_ = 1.0F;
};

}  // namespace morepro
