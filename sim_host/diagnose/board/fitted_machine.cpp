#include "sim_host/diagnose/board/fitted_machine.hpp"

#include <algorithm>

#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/outcome/parameter_report.hpp"
#include "sim_host/diagnose/search/winding_heat.hpp"

namespace morepro::host {
namespace {

void take_values(const AxisFit& fit, MachineParameters& machine) {
  const MachineParameters& fitted = fit.model().machine;
  if (fit.axis() == Axis::kSpindle)
    machine.spindle = fitted.spindle;
  else
    machine.feed = fitted.feed;
}

void take_fault(const SamplingFault& fault, const gap::EffectScales<double>& scales,
                MachineDescription& machine) {
  if (fault.effect == gap::Effect::kSensorQuantization) return;  // its sensor's steps
  std::erase_if(machine.effects,
                [&fault](const gap::AppliedEffect& known) { return known.form.effect == fault.effect; });
  machine.effects.push_back(gap::applied(fault.effect, fault.size, scales));
}

/// Steps that are a fault become their sensor's, and so do those of a sensor of which the file says nothing:
/// it states what was assumed of that from now on. Unless it states them as an effect already.
void take_steps(const RecordingSignals& signals, std::span<const SamplingFault> faults,
                MachineDescription& machine) {
  Sensors& sensors = machine.configuration.sensors;
  const bool is_known = std::ranges::any_of(machine.effects, [](const gap::AppliedEffect& known) {
    return known.form.effect == gap::Effect::kSensorQuantization;
  });
  if (!is_known) sensors = with_own_steps(sensors, signals, faults, machine.assumed_noise);
  for (const SamplingFault& fault : faults)
    if (fault.effect == gap::Effect::kSensorQuantization)
      sensors[fault.channel].lsb = signals.step[index_of(fault.channel)];
}

/// What a winding without a sensor is as warm by as the effect takes it for.
void take_heat(const WindingHeat& heat, MachineParameters::Spindle& spindle) {
  spindle.winding_time_constant_s = heat.time_s;
  spindle.winding_rise_k_a2 = heat.rise_k_a2;
}

}  // namespace

FittedValues fitted_values(const MachineParameters& datasheet, std::span<const AxisOutcome> outcomes) {
  FittedValues fitted{.without_effects = datasheet, .beside_effects = datasheet};
  for (const AxisOutcome& outcome : outcomes) {
    take_values(outcome.diagnosis.nominal, fitted.without_effects);
    const AxisFit& fit = outcome.diagnosis.fit;
    take_values(fit, fitted.beside_effects);
    (fit.axis() == Axis::kSpindle ? fitted.spindle_spread : fitted.feed_spread) = spread_of(fit);
  }
  return fitted;
}

MachineDescription machine_with_effects(MachineDescription machine, const RecordingSignals& signals,
                                        std::span<const AxisOutcome> outcomes,
                                        std::span<const SamplingFault> faults,
                                        const ScalesOfEffects& scales) {
  for (const SamplingFault& fault : faults) take_fault(fault, scales.stated, machine);
  take_steps(signals, faults, machine);
  for (const AxisOutcome& outcome : outcomes) {
    const AxisFit& fit = outcome.diagnosis.fit;
    take_values(fit, machine.configuration.machine);
    for (gap::AppliedEffect effect : fit.model().effects) {
      if (follows_heat(effect.form.effect, fit.signals()))
        take_heat(fit.signals().winding_heat, machine.configuration.machine.spindle);
      effect.onset_s = 0.0;
      machine.effects.push_back(gap::restated(effect, scales.found, scales.stated));
    }
  }
  return machine;
}

}  // namespace morepro::host
