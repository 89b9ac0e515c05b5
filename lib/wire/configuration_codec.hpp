#pragma once
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/wire/field_list.hpp"
#include "lib/wire/gap_codec.hpp"

namespace morepro::wire {

/// First byte of the payload. Another version is refused: a stored configuration is never read as something
/// else. To be raised with every change of the lists below.
inline constexpr std::uint8_t kConfigurationLayout = 7;

template <>
inline constexpr auto kFields<MachineParameters::Spindle> = std::tuple{
    &MachineParameters::Spindle::torque_constant_nm_a,
    &MachineParameters::Spindle::back_emf_constant_vs_rad,
    &MachineParameters::Spindle::resistance_ohm,
    &MachineParameters::Spindle::inductance_h,
    &MachineParameters::Spindle::inertia_kgm2,
    &MachineParameters::Spindle::viscous_friction_nms_rad,
    &MachineParameters::Spindle::winding_time_constant_s,
    &MachineParameters::Spindle::winding_rise_k_a2,
};

template <>
inline constexpr auto kFields<MachineParameters::Feed> = std::tuple{
    &MachineParameters::Feed::mass_kg,
    &MachineParameters::Feed::contact_force_n,
    &MachineParameters::Feed::contact_offset_n,
    &MachineParameters::Feed::engagement,
    &MachineParameters::Feed::viscous_friction_ns_m,
    &MachineParameters::Feed::screw_pitch_m,
};

template <>
inline constexpr auto kFields<MachineParameters::Tool> = std::tuple{
    &MachineParameters::Tool::diameter_mm,
    &MachineParameters::Tool::teeth,
    &MachineParameters::Tool::chip_load_mm,
};

template <>
inline constexpr auto kFields<MachineParameters::Contact> = std::tuple{
    &MachineParameters::Contact::form,         &MachineParameters::Contact::viscous_gain_nms,
    &MachineParameters::Contact::edge_force_n, &MachineParameters::Contact::chip_force_n_mm,
    &MachineParameters::Contact::radius_m,     &MachineParameters::Contact::speed_scale_rad_s,
};

template <>
inline constexpr auto kFields<MachineParameters::Thermal> = std::tuple{
    &MachineParameters::Thermal::reference_degc,
    &MachineParameters::Thermal::melting_degc,
    &MachineParameters::Thermal::exponent,
    &MachineParameters::Thermal::tool_degc,
};

template <>
inline constexpr auto kFields<MachineParameters> = std::tuple{
    &MachineParameters::spindle, &MachineParameters::feed,    &MachineParameters::tool,
    &MachineParameters::contact, &MachineParameters::thermal,
};

template <>
inline constexpr auto kFields<SensorNoise> = std::tuple{&SensorNoise::noise, &SensorNoise::lsb};

template <>
inline constexpr auto kFields<Sensors> = std::tuple{&Sensors::by_channel};

template <>
inline constexpr auto kFields<Sampling> = std::tuple{&Sampling::rate_hz};

template <>
inline constexpr auto kFields<HypothesisGrid> = std::tuple{
    &HypothesisGrid::first_mm,
    &HypothesisGrid::step_mm,
    &HypothesisGrid::count,
};

template <>
inline constexpr auto kFields<FilterTuning> = std::tuple{
    &FilterTuning::speed_process_noise_rad_s, &FilterTuning::current_process_noise_a,
    &FilterTuning::feed_process_noise_m_s,    &FilterTuning::chip_load_drift_mm,
    &FilterTuning::switch_probability,        &FilterTuning::parameter_start_fraction,
};

template <>
inline constexpr auto kFields<WearLimits> = std::tuple{
    &WearLimits::watch_ratio, &WearLimits::replace_ratio,       &WearLimits::low_ratio,
    &WearLimits::hold_s,      &WearLimits::datasheet_tolerance,
};

template <>
inline constexpr auto kFields<gap::EffectForm> = std::tuple{
    &gap::EffectForm::effect,
    &gap::EffectForm::kind,
    &gap::EffectForm::parts,
    &gap::EffectForm::shape,
};

template <>
inline constexpr auto kFields<gap::MachineForms> =
    std::tuple{&gap::MachineForms::form, &gap::MachineForms::count};

template <>
inline constexpr auto kFields<gap::GapLimits> = std::tuple{
    &gap::GapLimits::evidence,    &gap::GapLimits::temperature,      &gap::GapLimits::excitation,
    &gap::GapLimits::noise_ratio, &gap::GapLimits::parameter_spread, &gap::GapLimits::forms,
};

template <>
inline constexpr auto kFields<GapTuning> = std::tuple{
    &GapTuning::speed_process_noise_rad_s,
    &GapTuning::current_process_noise_a,
    &GapTuning::feed_process_noise_m_s,
    &GapTuning::lost_share,
    &GapTuning::clock_jitter_s,
    &GapTuning::spindle,
    &GapTuning::feed,
};

template <>
inline constexpr auto kFields<gap::AppliedEffect> = std::tuple{
    &gap::AppliedEffect::form,
    &gap::AppliedEffect::coefficient,
    &gap::AppliedEffect::onset_s,
};

template <>
inline constexpr auto kFields<MachineEffects> = std::tuple{&MachineEffects::effect, &MachineEffects::count};

template <>
inline constexpr auto kFields<MonitorConfiguration> = std::tuple{
    &MonitorConfiguration::machine, &MonitorConfiguration::sensors, &MonitorConfiguration::sampling,
    &MonitorConfiguration::grid,    &MonitorConfiguration::tuning,  &MonitorConfiguration::wear,
    &MonitorConfiguration::gap,     &MonitorConfiguration::effects, &MonitorConfiguration::rule,
};

template <>
constexpr bool is_known(ContactForm form) {
  switch (form) {
    case ContactForm::kConsistent:
    case ContactForm::kThesis:
      return true;
  }
  return false;
}

template <>
constexpr bool is_known(DecisionRule rule) {
  switch (rule) {
    case DecisionRule::kMarkov:
    case DecisionRule::kBayesian:
    case DecisionRule::kThesis:
      return true;
  }
  return false;
}

inline constexpr std::size_t kConfigurationPayload =
    sizeof(kConfigurationLayout) + wire_size<MonitorConfiguration>();
static_assert(kConfigurationPayload <= 1000,
              "a configuration must stay small: every receiver has a buffer for it");

inline void write_payload(ByteWriter& writer, const MonitorConfiguration& configuration) {
  writer.put(kConfigurationLayout);
  write_fields(writer, configuration);
}

/// Only the layout is checked here; whether the values make sense is the monitor's question.
inline void read_payload(ByteReader& reader, MonitorConfiguration& configuration) {
  if (reader.get<std::uint8_t>() != kConfigurationLayout) return reader.reject();
  read_fields(reader, configuration);
}

}  // namespace morepro::wire
