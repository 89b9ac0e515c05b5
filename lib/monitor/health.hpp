#pragma once
#include <array>
#include <cstdint>

#include "lib/gap/gap_watch_finding.hpp"
#include "lib/plant/parameter.hpp"

namespace morepro {

enum class HealthState : std::uint8_t {
  kNotEnoughData = 0,
  kHealthy = 1,
  kWatch = 2,
  kReplace = 3,
  kSensorFault = 4,
  kModelGap = 5,
};

enum class ChipLoadState : std::uint8_t { kUndetermined = 0, kValid = 1 };

/// Why a parameter's value may or may not be used. Values below kIdentifiable are not usable.
enum class ParameterStatus : std::uint8_t {
  kNoSignal = 0,         ///< a channel that it needs is not recorded
  kNoExcitation = 1,     ///< no information in the frames that may teach it: in the air, and in the cut
                         ///< while the chip load is as commanded
  kCorrelated = 2,       ///< only a combination with another parameter is determined
  kModelMismatch = 3,    ///< the model does not fit the data, so its parameters mean nothing
  kSamplingTooSlow = 4,  ///< fewer than one sample within L/R: the current moves unseen between two samples
  kIdentifiable = 5,
};

/// With which value only a combination is determined: the numbers of Parameter, and two more.
enum class Partner : std::uint8_t {
  kContactOffset = kParameterCount,  ///< of the feed axis: a constant engagement never tells it apart
  kNone = 255,
};
constexpr Partner partner_named(Parameter parameter) { return static_cast<Partner>(parameter); }
constexpr bool is_parameter(Partner partner) { return partner < Partner::kContactOffset; }

/// value +- standard_error in the unit of the machine file; meaningful where status is kIdentifiable, the
/// last value with its (large) standard error otherwise.
struct ParameterEstimate {
  float value = 0.0F;
  float standard_error = 0.0F;
  ParameterStatus status = ParameterStatus::kNoSignal;
  Partner partner = Partner::kNone;  ///< meaningful where status is kCorrelated or kIdentifiable
};

/// What the monitor says after one frame. Reason codes are explained in reason.hpp.
struct Health {
  std::uint32_t sequence = 0;  ///< of the frame that this answers
  std::uint32_t time_us = 0;
  HealthState state = HealthState::kNotEnoughData;
  std::uint16_t reason = 0;             ///< ReasonCode
  std::uint16_t frame_flags = 0;        ///< FrameFlag bits of this frame
  std::uint16_t rejected_channels = 0;  ///< bit_of(channel): a value of this frame that was not used
  std::uint32_t frames_accepted = 0;
  std::uint32_t frames_rejected = 0;
  std::uint32_t frames_missing = 0;

  ChipLoadState chip_load_state = ChipLoadState::kUndetermined;
  float chip_load_mm = 0.0F;
  float chip_load_standard_error_mm = 0.0F;

  std::uint8_t hypothesis_count = 0;
  std::uint8_t selected_hypothesis = 0;  ///< meaningful where chip_load_state is kValid
  float selected_probability = 0.0F;

  float spindle_speed_rad_s = 0.0F;
  float feed_speed_m_s = 0.0F;
  float armature_current_a = 0.0F;
  float innovation_ratio = 0.0F;  ///< windowed mean normalised innovation squared, 1 = as the model expects

  std::array<ParameterEstimate, kParameterCount> parameters{};  ///< in the order of Parameter

  gap::GapFinding gap{};  ///< between model and machine, from all that was seen so far
};

}  // namespace morepro
