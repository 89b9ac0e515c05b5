#pragma once
#include <cstddef>

#include "lib/c/machine_conversion.hpp"
#include "lib/c/morepro_configuration.h"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::c {

// As in machine_conversion.hpp: in either direction, field by field of the same name.

template <class From, class To>
constexpr void copy_tuning(const From& from, To& to) {
  to.speed_process_noise_rad_s = from.speed_process_noise_rad_s;
  to.current_process_noise_a = from.current_process_noise_a;
  to.feed_process_noise_m_s = from.feed_process_noise_m_s;
  to.chip_load_drift_mm = from.chip_load_drift_mm;
  to.switch_probability = from.switch_probability;
  to.parameter_start_fraction = from.parameter_start_fraction;
}

template <class From, class To>
constexpr void copy_wear(const From& from, To& to) {
  to.watch_ratio = from.watch_ratio;
  to.replace_ratio = from.replace_ratio;
  to.low_ratio = from.low_ratio;
  to.hold_s = from.hold_s;
  to.datasheet_tolerance = from.datasheet_tolerance;
}

template <class From, class To>
constexpr void copy_limits(const From& from, To& to) {
  to.evidence = from.evidence;
  to.temperature = from.temperature;
  to.excitation = from.excitation;
  to.noise_ratio = from.noise_ratio;
  to.parameter_spread = from.parameter_spread;
}

template <class From, class To>
constexpr void copy_gap(const From& from, To& to) {
  to.speed_process_noise_rad_s = from.speed_process_noise_rad_s;
  to.current_process_noise_a = from.current_process_noise_a;
  to.feed_process_noise_m_s = from.feed_process_noise_m_s;
  to.lost_share = from.lost_share;
  to.clock_jitter_s = from.clock_jitter_s;
  copy_limits(from.spindle, to.spindle);
  copy_limits(from.feed, to.feed);
}

/// An effect has a form, too.
template <class Form>
constexpr gap::EffectForm form_of(const Form& from) {
  gap::EffectForm to;
  set(from.effect, to.effect);
  to.kind = from.kind;
  to.parts = from.parts;
  to.shape = from.shape;
  return to;
}

constexpr gap::MachineForms forms_of(const morepro_gap_limits& from) {
  gap::MachineForms to;
  for (std::size_t i = 0; i < gap::MachineForms::kMost; ++i) to.form[i] = form_of(from.forms.form[i]);
  to.count = from.forms.count;
  return to;
}

constexpr gap::AppliedEffect to_cpp(const morepro_effect& from) {
  gap::AppliedEffect to;
  to.form = form_of(from);
  for (std::size_t i = 0; i < to.coefficient.size(); ++i) to.coefficient[i] = from.coefficient[i];
  to.onset_s = from.onset_s;
  return to;
}

/// The built-in configurations hold no effects and no forms, so those go one way only.
constexpr MonitorConfiguration to_cpp(const morepro_configuration& from) {
  MonitorConfiguration to;
  copy_machine(from.machine, to.machine);
  for (std::size_t i = 0; i < kChannelCount; ++i)
    to.sensors.by_channel[i] = {from.sensors[i].noise, from.sensors[i].lsb};
  to.sampling.rate_hz = from.rate_hz;
  to.grid = {.first_mm = from.grid.first_mm, .step_mm = from.grid.step_mm, .count = from.grid.count};
  copy_tuning(from.tuning, to.tuning);
  copy_wear(from.wear, to.wear);
  copy_gap(from.gap, to.gap);
  to.gap.spindle.forms = forms_of(from.gap.spindle);
  to.gap.feed.forms = forms_of(from.gap.feed);
  for (std::size_t i = 0; i < MachineEffects::kMost; ++i)
    to.effects.effect[i] = to_cpp(from.effects.effect[i]);
  to.effects.count = from.effects.count;
  set(from.rule, to.rule);
  return to;
}

constexpr morepro_configuration to_c(const MonitorConfiguration& from) {
  morepro_configuration to{};
  copy_machine(from.machine, to.machine);
  for (std::size_t i = 0; i < kChannelCount; ++i)
    to.sensors[i] = {from.sensors.by_channel[i].noise, from.sensors.by_channel[i].lsb};
  to.rate_hz = from.sampling.rate_hz;
  to.grid = {from.grid.first_mm, from.grid.step_mm, from.grid.count};
  copy_tuning(from.tuning, to.tuning);
  copy_wear(from.wear, to.wear);
  copy_gap(from.gap, to.gap);
  set(from.rule, to.rule);
  return to;
}

static_assert(MOREPRO_MOST_EFFECTS == MachineEffects::kMost);
static_assert(MOREPRO_MOST_PARTS == gap::kMostParts);
static_assert(MOREPRO_MOST_FORMS == gap::MachineForms::kMost);
static_assert(MOREPRO_MOST_PARTS == gap::MachineForms::kMostParts);
static_assert(MOREPRO_CHANNELS == kChannelCount);

}  // namespace morepro::c
