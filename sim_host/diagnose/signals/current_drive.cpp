#include "sim_host/diagnose/signals/current_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

constexpr double kInductanceH = 1.0;
constexpr double kNothing = 1.0e-9;  // a resistance and a back-EMF constant that no current feels
constexpr double kFollows = 1000.0;  // standard deviations of the sensor that the current may change by

}  // namespace

bool drive_by_current(RecordingSignals& signals) {
  if (signals.has(Channel::kArmatureVoltage) || !signals.has(Channel::kArmatureCurrent) ||
      !signals.has(Channel::kSpindleSpeed))
    return false;
  const auto& current_a = signals.value[index_of(Channel::kArmatureCurrent)];
  auto& voltage_v = signals.value[index_of(Channel::kArmatureVoltage)];
  const auto per_change = static_cast<float>(kInductanceH * signals.rate_hz);
  voltage_v.assign(signals.rows, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i + 1 < std::min(signals.rows, current_a.size()); ++i)
    voltage_v[i] = per_change * (current_a[i + 1] - current_a[i]);
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(Channel::kArmatureVoltage));
  signals.is_current_driven = true;
  return true;
}

CurrentSource current_source(const MachineParameters& machine, const gap::GapNoise<double>& noise) {
  CurrentSource source{machine, noise};
  source.machine.spindle.inductance_h = kInductanceH;
  source.machine.spindle.resistance_ohm = kNothing;
  source.machine.spindle.back_emf_constant_vs_rad = kNothing;
  source.noise.current_step = kFollows * std::sqrt(std::max(noise.current_variance, kNothing));
  return source;
}

}  // namespace morepro::host
