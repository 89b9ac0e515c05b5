#pragma once
#include <cstdint>

#include "lib/frame/frame_view.hpp"
#include "lib/gap/gap_watch.hpp"
#include "lib/gap/reference_point.hpp"
#include "lib/monitor/held_inputs.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/sample_limits.hpp"

namespace morepro {

/// Shows the watch of the gap between model and machine what it may learn from: frames without a gap, sensors
/// that the configuration describes and that are not suspected, an axis whose inputs are known.
class GapTracker {
 public:
  [[gnu::cold]] explicit GapTracker(const MonitorConfiguration& c)
      : described_(described_by(c.sensors)),
        watch_(c.machine, gap::reference_point_of(c.machine), 1.0 / c.sampling.rate_hz, settings_of(c)) {}

  /// The next frame does not follow the last one; so many were lost between them, where that is known.
  [[gnu::noinline, gnu::cold]] void interrupt(std::uint32_t lost) {
    watch_.count_lost(lost);
    watch_.interrupt();
  }
  /// A sensor is suspected: neither this frame nor the ones just before it may be learnt from.
  void distrust() { watch_.abandon(); }

  /// One frame. `held`: its inputs and what was measured last; `usable`: bit_of(channel) of what may be used.
  void step(const HeldInputs& held, std::uint16_t usable) {
    if (watch_.is_resting())
      return watch_.rest(held.get(Channel::kSpindleSpeed), held.get(Channel::kFeedSpeed), held.contact());
    // An input that is missing is not the one that held last.
    if ((held.known() & kInputs & ~unsigned{usable}) != 0) watch_.interrupt();
    if (knows_spindle(held) != knew_spindle_) watch_.interrupt();
    knew_spindle_ = knows_spindle(held);
    watch_.step(frame_of(held, usable & (described_ | bit_of(Channel::kSpindleAngle))));
  }

  [[nodiscard]] const gap::GapFinding& finding() const { return watch_.finding(); }

  /// What the watch is shown of a frame.
  static gap::GapFrame<float> frame_of(const HeldInputs& held, unsigned usable) {
    const auto has = [usable](Channel channel) { return (usable & bit_of(channel)) != 0; };
    const bool spindle = knows_spindle(held);
    const bool feed = held.knows(Channel::kFeedForce);
    gap::GapFrame<float> frame;
    frame.input = held.plant();
    frame.winding_degc = held.winding_degc();
    frame.speed_rad_s = held.get(Channel::kSpindleSpeed);
    frame.current_a = held.get(Channel::kArmatureCurrent);
    frame.angle_rad = held.get(Channel::kSpindleAngle);
    frame.feed_speed_m_s = held.get(Channel::kFeedSpeed);
    frame.feed_position_m = held.get(Channel::kFeedPosition);
    frame.has_speed = spindle && has(Channel::kSpindleSpeed);
    frame.has_current = spindle && has(Channel::kArmatureCurrent);
    frame.has_angle = has(Channel::kSpindleAngle);
    frame.has_feed_speed = feed && has(Channel::kFeedSpeed);
    frame.has_feed_position = feed && has(Channel::kFeedPosition);
    return frame;
  }

 private:
  static constexpr unsigned kInputs = bit_of(Channel::kArmatureVoltage) | bit_of(Channel::kFeedForce) |
                                      bit_of(Channel::kContact) | bit_of(Channel::kEngagement) |
                                      bit_of(Channel::kChipLoad) | bit_of(Channel::kToolTemperature);

  static unsigned described_by(const Sensors& sensors) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < kChannelCount; ++i)
      if (sensors.by_channel[i].variance() > 0.0) bits |= 1U << i;
    return bits;
  }

  static gap::GapSettings settings_of(const MonitorConfiguration& c) {
    gap::GapSettings settings{
        .noise = {}, .spindle = c.gap.spindle, .feed = c.gap.feed, .samples = sample_limits_of(c)};
    settings.noise.speed_variance = c.sensors[Channel::kSpindleSpeed].variance();
    settings.noise.current_variance = c.sensors[Channel::kArmatureCurrent].variance();
    settings.noise.feed_speed_variance = c.sensors[Channel::kFeedSpeed].variance();
    settings.noise.feed_position_variance = c.sensors[Channel::kFeedPosition].variance();
    settings.noise.speed_step = c.gap.speed_process_noise_rad_s;
    settings.noise.current_step = c.gap.current_process_noise_a;
    settings.noise.feed_step = c.gap.feed_process_noise_m_s;
    return settings;
  }

  /// What the spindle is driven with and cuts is known. In the air nothing is cut.
  static bool knows_spindle(const HeldInputs& held) {
    return held.knows(Channel::kArmatureVoltage) && (held.knows(Channel::kChipLoad) || !held.is_in_contact());
  }

  unsigned described_;
  bool knew_spindle_ = false;
  gap::GapWatch<float> watch_;
};

}  // namespace morepro
