#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/diagnosis.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/signals/reference_scales.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/simulate/datasheet.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/simulate/simulation.hpp"
#include "tests/support/reference_effect.hpp"

namespace morepro::diagnose_test {

using gap::Effect;
using host::DiagnosisResult;
using host::MachineDescription;
using host::RecordingSignals;
using test::effect;

/// One simulated recording of the reference machine.
struct SimulatedRun {
  std::vector<gap::AppliedEffect> effects{};
  double duration_s = 3.0;
  double rate_hz = host::SimulationOptions{}.rate_hz;
  std::uint64_t seed = 3;
  host::ProfileKind profile = host::ProfileKind::kRich;
  MonitorConfiguration configuration = reference_configuration();
  double process_noise = 0.0;
};

inline RecordingSignals record(const SimulatedRun& run) {
  host::SimulationOptions options{.profile = run.profile, .duration_s = run.duration_s, .seed = run.seed};
  options.rate_hz = run.rate_hz;
  options.effects = run.effects;
  options.process_noise = run.process_noise;
  host::Simulation simulation(run.configuration, options);
  RecordingSignals signals;
  signals.rate_hz = options.rate_hz;
  signals.rows = simulation.frame_count();
  signals.recorded = simulation.recorded();
  for (std::size_t c = 0; c < kChannelCount; ++c)
    if (signals.has(static_cast<Channel>(c)))
      signals.value[c].assign(signals.rows, std::numeric_limits<float>::quiet_NaN());
  std::size_t frames = 0;
  for (SensorFrame frame; simulation.next(frame); ++frames)
    for (std::size_t c = 0; c < kChannelCount; ++c)
      if (frame.has(static_cast<Channel>(c))) signals.value[c][frame.sequence] = frame.value[c];
  signals.missing_rows = signals.rows - frames;
  host::count_cutting_time(signals);
  return signals;
}

/// Nothing but the inputs moves the sensors.
inline MonitorConfiguration noiseless() {
  MonitorConfiguration configuration = reference_configuration();
  for (SensorNoise& sensor : configuration.sensors.by_channel)
    if (sensor.noise > 0.0) sensor = {1.0e-12, 0.0};
  return configuration;
}

/// The next sample of a recording that is made here.
inline void show(RecordingSignals& signals, Channel channel, double value) {
  signals.recorded = static_cast<std::uint16_t>(signals.recorded | bit_of(channel));
  signals.value[index_of(channel)].push_back(static_cast<float>(value));
}

inline void leave_out(RecordingSignals& signals, Channel channel) {
  signals.value[index_of(channel)].clear();
  signals.recorded = static_cast<std::uint16_t>(signals.recorded & ~bit_of(channel));
}

/// The reference machine's datasheet, wrong by `fraction`, up and down in turn.
inline MachineDescription datasheet(double fraction) {
  MachineDescription machine = host::built_in_machine("reference");
  auto& s = machine.configuration.machine.spindle;
  auto& f = machine.configuration.machine.feed;
  double sign = 1.0;
  for (double* value :
       {&s.torque_constant_nm_a, &s.viscous_friction_nms_rad, &s.inertia_kgm2, &s.resistance_ohm,
        &s.back_emf_constant_vs_rad, &s.inductance_h, &f.mass_kg, &f.viscous_friction_ns_m}) {
    *value *= 1.0 + sign * fraction;
    sign = -sign;
  }
  return machine;
}

/// The same off by a fifth at most, as `simulate --datasheet-error 0.2` writes it.
inline MachineDescription wrong_datasheet(std::uint64_t seed) {
  MachineDescription machine = datasheet(0.0);
  machine.configuration.machine = host::datasheet_of(machine.configuration.machine, 0.2, seed);
  return machine;
}

/// What a diagnosis begins with: the machine file's model.
inline host::GapModel gap_model(const MachineDescription& sheet, const RecordingSignals& signals) {
  return {.machine = sheet.configuration.machine,
          .point = host::reference_point_for(sheet, signals),
          .noise = host::usual_noise(sheet.configuration.sensors)};
}

inline DiagnosisResult diagnosed(RecordingSignals signals, const MachineDescription& machine,
                                 std::vector<Effect> excluded = {}, int bootstrap_runs = 0) {
  host::DiagnosisOptions options{.bootstrap_runs = bootstrap_runs, .excluded = std::move(excluded)};
  MachineDescription with_effects;
  return host::diagnose(std::move(signals), machine, options, with_effects);
}

inline bool names(const host::EffectResult& found, Effect name) {
  const auto& aliases = found.alias_set;
  return found.effect == name || std::find(aliases.begin(), aliases.end(), name) != aliases.end();
}

/// "spindle_windage {spindle_windage, ...}; ...": what a failed test shows.
inline std::string said(const DiagnosisResult& result) {
  std::string text(host::name_of(result.verdict));
  for (const auto& found : result.which) {
    text.append("; ")
        .append(gap::name_of(found.effect))
        .append(" = ")
        .append(std::to_string(found.magnitude))
        .append(" {");
    for (const Effect alias : found.alias_set) text.append(" ").append(gap::name_of(alias));
    text.append(" }");
  }
  return text;
}

}  // namespace morepro::diagnose_test
