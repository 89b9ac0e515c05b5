#pragma once
#include <cstddef>

#include "lib/c/machine_conversion.hpp"
#include "lib/c/morepro_health.h"
#include "lib/monitor/health.hpp"

namespace morepro::c {

inline void copy_gap_finding(const gap::GapFinding& from, morepro_gap& to) {
  set(from.verdict, to.verdict);
  set(from.where, to.where);
  set(from.effect, to.effect);
  to.alias_count = from.alias_count;
  for (std::size_t i = 0; i < gap::kMostAliases; ++i) set(from.alias[i], to.alias[i]);
  to.confidence = from.confidence;
  to.evidence = from.evidence;
}

inline void copy_parameter(const ParameterEstimate& from, morepro_parameter& to) {
  to.value = from.value;
  to.standard_error = from.standard_error;
  set(from.status, to.status);
  set(from.partner, to.partner);
  to.is_identifiable = from.status == ParameterStatus::kIdentifiable ? 1 : 0;
}

/// Everything but the probabilities, which only the monitor knows.
inline void copy_health(const Health& from, morepro_health& to) {
  to.sequence = from.sequence;
  to.time_us = from.time_us;
  set(from.state, to.state);
  to.reason = from.reason;
  to.frame_flags = from.frame_flags;
  to.rejected_channels = from.rejected_channels;
  to.frames_accepted = from.frames_accepted;
  to.frames_rejected = from.frames_rejected;
  to.frames_missing = from.frames_missing;
  to.chip_load_is_valid = from.chip_load_state == ChipLoadState::kValid ? 1 : 0;
  to.chip_load_mm = from.chip_load_mm;
  to.chip_load_standard_error_mm = from.chip_load_standard_error_mm;
  to.hypothesis_count = from.hypothesis_count;
  to.selected_hypothesis = from.selected_hypothesis;
  to.selected_probability = from.selected_probability;
  to.spindle_speed_rad_s = from.spindle_speed_rad_s;
  to.feed_speed_m_s = from.feed_speed_m_s;
  to.armature_current_a = from.armature_current_a;
  to.innovation_ratio = from.innovation_ratio;
  for (std::size_t i = 0; i < kParameterCount; ++i) copy_parameter(from.parameters[i], to.parameters[i]);
  copy_gap_finding(from.gap, to.gap);
}

static_assert(MOREPRO_PARAMETERS == kParameterCount);
static_assert(MOREPRO_MOST_ALIASES == gap::kMostAliases);

}  // namespace morepro::c
