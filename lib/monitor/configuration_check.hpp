#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/gap/board_forms.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro {
namespace detail {

struct CheckedValue {
  double value;
  std::string_view key;
};

inline bool is_finite(double x) { return x - x == 0.0; }

/// Beyond these a value is a mistake of units, and its square or quotient may leave the range of a float.
inline constexpr double kSmallest = 1.0e-12;
inline constexpr double kLargest = 1.0e9;
inline constexpr double kLargestNoise = 1.0e5;

[[gnu::cold]] inline ConfigurationResult check_all(std::span<const CheckedValue> values, bool zero_allowed,
                                                   double largest = kLargest) {
  for (const auto& [value, key] : values) {
    if (!is_finite(value)) return {ConfigurationError::kNotFinite, key};
    if (zero_allowed && !(value >= 0.0)) return {ConfigurationError::kNegative, key};
    if (!zero_allowed && !(value > 0.0)) return {ConfigurationError::kNotPositive, key};
    if (value > largest || (value > 0.0 && value < kSmallest)) return {ConfigurationError::kMagnitude, key};
  }
  return {};
}

[[gnu::cold]] inline ConfigurationResult check_positive(const MonitorConfiguration& c) {
  const auto& [spindle, feed, tool, contact, thermal] = c.machine;
  return check_all(std::to_array<CheckedValue>({
                       {spindle.torque_constant_nm_a, "spindle.torque_constant_nm_a"},
                       {spindle.back_emf_constant_vs_rad, "spindle.back_emf_constant_vs_rad"},
                       {spindle.resistance_ohm, "spindle.resistance_ohm"},
                       {spindle.inductance_h, "spindle.inductance_h"},
                       {spindle.inertia_kgm2, "spindle.inertia_kgm2"},
                       {feed.mass_kg, "feed.mass_kg"},
                       {tool.diameter_mm, "tool.diameter_mm"},
                       {tool.teeth, "tool.teeth"},
                       {tool.chip_load_mm, "tool.chip_load_mm"},
                       {contact.speed_scale_rad_s, "contact.speed_scale_rad_s"},
                       {thermal.exponent, "thermal.exponent"},
                       {c.tuning.speed_process_noise_rad_s, "tuning.speed_process_noise_rad_s"},
                       {c.tuning.current_process_noise_a, "tuning.current_process_noise_a"},
                       {c.tuning.feed_process_noise_m_s, "tuning.feed_process_noise_m_s"},
                       {c.tuning.parameter_start_fraction, "tuning.parameter_start_fraction"},
                       {c.grid.first_mm, "grid.first_mm"},
                       {c.grid.step_mm, "grid.step_mm"},
                       {c.wear.low_ratio, "wear.low_ratio"},
                       {c.gap.spindle.evidence, "gap.spindle_evidence"},
                       {c.gap.spindle.excitation, "gap.spindle_excitation"},
                       {c.gap.spindle.noise_ratio, "gap.spindle_noise_ratio"},
                       {c.gap.spindle.parameter_spread, "gap.spindle_parameter_spread"},
                       {c.gap.feed.evidence, "gap.feed_evidence"},
                       {c.gap.feed.excitation, "gap.feed_excitation"},
                       {c.gap.feed.noise_ratio, "gap.feed_noise_ratio"},
                       {c.gap.feed.parameter_spread, "gap.feed_parameter_spread"},
                   }),
                   false);
}

[[gnu::cold]] inline ConfigurationResult check_not_negative(const MonitorConfiguration& c) {
  const auto& [spindle, feed, tool, contact, thermal] = c.machine;
  return check_all(std::to_array<CheckedValue>({
                       {spindle.viscous_friction_nms_rad, "spindle.viscous_friction_nms_rad"},
                       {spindle.winding_time_constant_s, "spindle.winding_time_constant_s"},
                       {spindle.winding_rise_k_a2, "spindle.winding_rise_k_a2"},
                       {feed.contact_force_n, "feed.contact_force_n"},
                       {feed.contact_offset_n, "feed.contact_offset_n"},
                       {feed.engagement, "feed.engagement"},
                       {feed.viscous_friction_ns_m, "feed.viscous_friction_ns_m"},
                       {feed.screw_pitch_m, "feed.screw_pitch_m"},
                       {contact.viscous_gain_nms, "contact.viscous_gain_nms"},
                       {contact.edge_force_n, "contact.edge_force_n"},
                       {contact.chip_force_n_mm, "contact.chip_force_n_mm"},
                       {contact.radius_m, "contact.radius_m"},
                       {c.tuning.chip_load_drift_mm, "tuning.chip_load_drift_mm"},
                       {c.wear.hold_s, "wear.hold_s"},
                       {c.wear.datasheet_tolerance, "wear.datasheet_tolerance"},
                       {c.wear.watch_ratio - 1.0, "wear.watch_ratio"},
                       {c.wear.replace_ratio - c.wear.watch_ratio, "wear.replace_ratio"},
                       {1.0 - c.wear.low_ratio, "wear.low_ratio"},
                       {c.gap.speed_process_noise_rad_s, "gap.speed_process_noise_rad_s"},
                       {c.gap.current_process_noise_a, "gap.current_process_noise_a"},
                       {c.gap.feed_process_noise_m_s, "gap.feed_process_noise_m_s"},
                       {c.gap.lost_share, "gap.lost_share"},
                       {1.0 - c.gap.lost_share, "gap.lost_share"},
                       {c.gap.clock_jitter_s, "gap.clock_jitter_s"},
                       {c.gap.spindle.temperature - 1.0, "gap.spindle_temperature"},
                       {c.gap.feed.temperature - 1.0, "gap.feed_temperature"},
                   }),
                   true);
}

inline ConfigurationResult check_sensors(const Sensors& sensors) {
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const std::array<CheckedValue, 2> values{{{sensors.by_channel[i].noise, kChannels[i].column},
                                              {sensors.by_channel[i].lsb, kChannels[i].column}}};
    if (const auto result = check_all(values, true, kLargestNoise); !result.ok()) return result;
  }
  return {};
}

inline ConfigurationResult check_temperatures(const MachineParameters::Thermal& thermal) {
  using enum ConfigurationError;
  if (!is_finite(thermal.tool_degc)) return {kNotFinite, "thermal.tool_degc"};
  if (!(thermal.melting_degc > thermal.reference_degc)) return {kThermalRange, "thermal.melting_degc"};
  return {};
}

[[gnu::cold]] inline ConfigurationResult check_ranges(const MonitorConfiguration& c, std::size_t capacity) {
  using enum ConfigurationError;
  if (const auto result = check_temperatures(c.machine.thermal); !result.ok()) return result;
  if (!(c.sampling.rate_hz >= 100.0 && c.sampling.rate_hz <= 20000.0))
    return {kSamplingRate, "sampling.rate_hz"};
  if (!(c.tuning.switch_probability > 0.0 && c.tuning.switch_probability < 1.0))
    return {kNotAProbability, "tuning.switch_probability"};
  if (c.grid.count < 1 || c.grid.count > capacity) return {kHypothesisCount, "grid.count"};
  if (!is_inside_contact_range(c.machine, c.grid.first_mm)) return {kHypothesisOutsideLaw, "grid.first_mm"};
  if (!is_inside_contact_range(c.machine, c.grid.value_mm(c.grid.count - 1)))
    return {kHypothesisOutsideLaw, "grid.step_mm"};
  return {};
}

inline ConfigurationResult check_shape(const gap::EffectForm& form, double rate_hz, std::string_view key) {
  using enum ConfigurationError;
  const auto shape = static_cast<double>(form.shape);
  if (!is_finite(shape)) return {kNotFinite, key};
  if (!(shape >= 0.0) || (gap::needs_shape(form.effect) && !(shape > 0.0))) return {kEffectShape, key};
  if (shape > kLargest || (shape > 0.0 && shape < kSmallest)) return {kMagnitude, key};
  constexpr double kLongestDelay = static_cast<double>(gap::kBoardDelaySteps) + 1.0e-3;  // a shape is a float
  if (gap::is_delay(form.effect) && shape * rate_hz > kLongestDelay) return {kEffectDelay, key};
  return {};
}

inline ConfigurationResult check_effect(const gap::AppliedEffect& one, double rate_hz) {
  using enum ConfigurationError;
  const auto& form = one.form;
  if (gap::index_of(form.effect) >= gap::kEffectCount) return {kEffectUnknown, "effects.name"};
  if (form.parts < 1 || form.parts > gap::kMostParts) return {kEffectParts, "effects.coefficients"};
  if (const auto result = check_shape(form, rate_hz, "effects.shape"); !result.ok()) return result;
  for (const double coefficient : one.coefficient) {
    if (!is_finite(coefficient)) return {kNotFinite, "effects.coefficients"};
    if (coefficient > kLargest || coefficient < -kLargest) return {kMagnitude, "effects.coefficients"};
  }
  return check_all(std::array<CheckedValue, 1>{{{one.onset_s, "effects.onset_s"}}}, true);
}

[[gnu::cold]] inline ConfigurationResult check_effects(const MonitorConfiguration& c) {
  if (c.effects.count > MachineEffects::kMost) return {ConfigurationError::kEffectCount, "effects"};
  for (std::size_t i = 0; i < c.effects.count; ++i)
    if (const auto result = check_effect(c.effects.effect[i], c.sampling.rate_hz); !result.ok())
      return result;
  return {};
}

[[gnu::cold]] inline ConfigurationResult check_forms(const gap::MachineForms& forms, double rate_hz) {
  using enum ConfigurationError;
  if (forms.count > gap::MachineForms::kMost) return {kEffectCount, "gap.forms"};
  std::size_t parts = 0;
  for (std::size_t i = 0; i < forms.count; ++i) {
    const gap::EffectForm& form = forms.form[i];
    parts += form.parts;
    if (gap::index_of(form.effect) >= gap::kEffectCount) return {kEffectUnknown, "gap.forms"};
    if (form.parts == 0) continue;  // takes a form away and has no shape
    if (const auto result = check_shape(form, rate_hz, "gap.forms"); !result.ok()) return result;
  }
  return parts > gap::MachineForms::kMostParts ? ConfigurationResult{kEffectParts, "gap.forms"}
                                               : ConfigurationResult{};
}

}  // namespace detail

/// Is one effect such that a monitor at this sampling rate can take it out of its frames?
inline ConfigurationResult check_effect(const gap::AppliedEffect& effect, double rate_hz) {
  return detail::check_effect(effect, rate_hz);
}

/// Is every value of a machine possible?
inline ConfigurationResult check(const MachineParameters& machine) {
  MonitorConfiguration configuration;
  configuration.machine = machine;
  if (const auto result = detail::check_positive(configuration); !result.ok()) return result;
  if (const auto result = detail::check_not_negative(configuration); !result.ok()) return result;
  return detail::check_temperatures(machine.thermal);
}

/// Is every value of a configuration possible? `capacity`: hypotheses that the bank can hold. Returns the
/// first refusal with its key. Cold: small instead of fast.
[[gnu::cold]] inline ConfigurationResult check(const MonitorConfiguration& configuration,
                                               std::size_t capacity) {
  if (const auto result = detail::check_positive(configuration); !result.ok()) return result;
  if (const auto result = detail::check_not_negative(configuration); !result.ok()) return result;
  if (const auto result = detail::check_sensors(configuration.sensors); !result.ok()) return result;
  if (const auto result = detail::check_ranges(configuration, capacity); !result.ok()) return result;
  const double rate_hz = configuration.sampling.rate_hz;
  if (const auto result = detail::check_forms(configuration.gap.spindle.forms, rate_hz); !result.ok())
    return result;
  if (const auto result = detail::check_forms(configuration.gap.feed.forms, rate_hz); !result.ok())
    return result;
  return detail::check_effects(configuration);
}

}  // namespace morepro
