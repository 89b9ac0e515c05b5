#pragma once
#include "lib/monitor/health.hpp"
#include "lib/wire/field_list.hpp"
#include "lib/wire/gap_codec.hpp"

namespace morepro::wire {

template <>
inline constexpr auto kFields<ParameterEstimate> =
    std::tuple{&ParameterEstimate::value, &ParameterEstimate::standard_error, &ParameterEstimate::status,
               &ParameterEstimate::partner};

template <>
inline constexpr auto kFields<Health> = std::tuple{
    &Health::sequence,
    &Health::time_us,
    &Health::state,
    &Health::reason,
    &Health::frame_flags,
    &Health::rejected_channels,
    &Health::frames_accepted,
    &Health::frames_rejected,
    &Health::frames_missing,
    &Health::chip_load_state,
    &Health::chip_load_mm,
    &Health::chip_load_standard_error_mm,
    &Health::hypothesis_count,
    &Health::selected_hypothesis,
    &Health::selected_probability,
    &Health::spindle_speed_rad_s,
    &Health::feed_speed_m_s,
    &Health::armature_current_a,
    &Health::innovation_ratio,
    &Health::parameters,
    &Health::gap,
};

template <>
constexpr bool is_known(HealthState state) {
  switch (state) {
    case HealthState::kNotEnoughData:
    case HealthState::kHealthy:
    case HealthState::kWatch:
    case HealthState::kReplace:
    case HealthState::kSensorFault:
    case HealthState::kModelGap:
      return true;
  }
  return false;
}

template <>
constexpr bool is_known(ChipLoadState state) {
  switch (state) {
    case ChipLoadState::kUndetermined:
    case ChipLoadState::kValid:
      return true;
  }
  return false;
}

template <>
constexpr bool is_known(ParameterStatus status) {
  switch (status) {
    case ParameterStatus::kNoSignal:
    case ParameterStatus::kNoExcitation:
    case ParameterStatus::kCorrelated:
    case ParameterStatus::kModelMismatch:
    case ParameterStatus::kSamplingTooSlow:
    case ParameterStatus::kIdentifiable:
      return true;
  }
  return false;
}

template <>
constexpr bool is_known(Partner partner) {
  return is_parameter(partner) || partner == Partner::kContactOffset || partner == Partner::kNone;
}

inline constexpr std::size_t kHealthPayload = wire_size<Health>();
static_assert(kHealthPayload <= 240, "a health message must stay within one run of the byte stuffing");

/// Equal results are equal bytes: every NaN is sent as the same one.
inline void write_payload(ByteWriter& writer, const Health& health) { write_fields(writer, health); }
inline void read_payload(ByteReader& reader, Health& health) {
  read_fields(reader, health);
  if (health.gap.alias_count > gap::kMostAliases) reader.reject();
}

}  // namespace morepro::wire
