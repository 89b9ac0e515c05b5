#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/gap/applied_effect.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// A fault of the acquisition that stands in the samples themselves.
struct SamplingFault {
  gap::Effect effect = gap::Effect::kSensorQuantization;
  Channel channel = Channel::kSpindleSpeed;
  double size = 0.0;
  double standard_error = 0.0;
  double evidence = 0.0;
  double onset_s = 0.0;  ///< 0: there from the start
};

/// The step that all values of a column are multiples of; 0 where there is none.
double step_of(const std::vector<float>& column);

/// Steps that are coarser than the machine file says; the sensor's last bit in `sensors` is set to them. The
/// steps of all sensors are noted in `signals`, with what their rounding may be worth to a cause. Of those
/// that are `assumed`, bit_of(channel), the file says nothing: steps are a fault where they hide the noise.
/// Those that have steps `of_their_own`, that are known, are not looked at.
std::vector<SamplingFault> find_quantization(RecordingSignals& signals, Sensors& sensors,
                                             std::uint16_t assumed = 0, std::uint16_t of_their_own = 0);

inline constexpr std::uint16_t kAllChannels = 0xFFFF;

/// The sensors with the steps that the machine is known to have beside them.
Sensors with_known_steps(Sensors sensors, std::span<const gap::AppliedEffect> known);

/// The sensors, those of `channels` (bit_of(channel)) with the steps that a recording has of which no fault
/// is told.
Sensors with_own_steps(Sensors sensors, const RecordingSignals& signals,
                       std::span<const SamplingFault> faults, std::uint16_t channels = kAllChannels);

/// Takes out those that the machine is known to have about that much of.
void leave_out_known(std::span<const gap::AppliedEffect> known, std::vector<SamplingFault>& faults);

/// Takes out the sensors that show one value only, although they have noise: they are dead.
std::vector<Channel> leave_out_dead_sensors(RecordingSignals& signals, const Sensors& sensors);

/// Rows that are missing or repeat the one before; repeated samples are taken out of `signals`.
std::optional<SamplingFault> find_dropout(RecordingSignals& signals);

/// Deviance per row of structure that these may leave, of which nobody could say whether it is the machine's:
/// a coarse step and a jittering clock any, lost samples a little.
double structure_left_by(const std::vector<SamplingFault>& faults);

/// Where a sensor's faults show most.
constexpr gap::Balance balance_shown_by(Channel channel) {
  if (channel == Channel::kArmatureCurrent) return gap::Balance::kArmatureVoltage;
  return channel == Channel::kSpindleSpeed ? gap::Balance::kSpindleTorque : gap::Balance::kFeedForce;
}

}  // namespace morepro::host
