#pragma once
#include <cstdint>

#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/reason.hpp"

namespace morepro {

/// What one frame says about the chip load.
struct ChipLoadEvidence {
  bool is_in_contact = false;
  bool has_signals = false;  ///< voltage, contact, speed and current are all there
  bool is_commanded =
      false;  ///< the commanded chip load is recorded; else the machine's nominal one stands in
  float reference_mm = 0.0F;  ///< commanded or nominal
  float estimate_mm = 0.0F;
  float standard_error_mm = 0.0F;
  float datasheet_error_mm = 0.0F;  ///< what a datasheet within its tolerance may make of the chip load
  bool is_inside_law = true;        ///< the contact law was not clamped
  std::uint32_t frames_known = 0;   ///< frames in contact since the chip load was last unknown
};

struct Verdict {
  HealthState state = HealthState::kNotEnoughData;
  ReasonCode reason = ReasonCode::kWearNoContact;
};

/// Judges the tool by the chip load that its torque looks like, against the one that was commanded: a blunt
/// edge needs the torque of a thicker chip. A verdict needs the excess to be significant (two standard
/// errors) and to last; REPLACE stays until the tool is changed, because wear does not heal. Where the
/// command is not recorded, a programmed change looks like wear, so WATCH is the most that is said.
class WearJudge {
 public:
  WearJudge(const WearLimits& limits, double rate_hz)
      : limits_{static_cast<float>(limits.watch_ratio), static_cast<float>(limits.replace_ratio),
                static_cast<float>(limits.low_ratio)},
        hold_frames_(static_cast<std::uint32_t>(limits.hold_s * rate_hz + 0.5)) {}

  Verdict judge(const ChipLoadEvidence& e) {
    const Verdict now = judge_now(e);
    if (now.state == HealthState::kReplace) is_worn_ = true;
    if (is_worn_) return {HealthState::kReplace, ReasonCode::kWearLoadHigh};
    return now;
  }

  /// The evidence is not to be trusted now: nothing that was seen so far counts towards a verdict.
  void distrust() { frames_high_ = frames_raised_ = frames_low_ = 0; }
  [[nodiscard]] bool is_worn() const { return is_worn_; }

  /// A new tool.
  void tool_changed() {
    is_worn_ = false;
    distrust();
  }

 private:
  struct Limits {
    float watch, replace, low;
  };
  static constexpr float kSettledFraction = 0.1F;  // standard error against the reference
  static constexpr std::uint32_t kSettlingFrames = 20;

  Verdict judge_now(const ChipLoadEvidence& e) {
    if (!e.has_signals) return {HealthState::kNotEnoughData, ReasonCode::kSensorMissing};
    if (!e.is_in_contact) return {HealthState::kNotEnoughData, ReasonCode::kWearNoContact};
    if (!e.is_inside_law) return {HealthState::kNotEnoughData, ReasonCode::kModelOutsideLaw};
    if (e.frames_known < kSettlingFrames || !(e.standard_error_mm <= kSettledFraction * e.reference_mm))
      return {HealthState::kNotEnoughData, ReasonCode::kWearSettling};
    count(e);
    if (frames_high_ >= hold_frames_ && e.is_commanded)
      return {HealthState::kReplace, ReasonCode::kWearLoadHigh};
    if (frames_raised_ >= hold_frames_)
      return {HealthState::kWatch,
              e.is_commanded ? ReasonCode::kWearLoadRaised : ReasonCode::kWearNoReference};
    if (frames_low_ >= hold_frames_) return {HealthState::kWatch, ReasonCode::kWearLoadLow};
    return {HealthState::kHealthy, ReasonCode::kWearAsCommanded};
  }

  void count(const ChipLoadEvidence& e) {
    const float certain_low = e.estimate_mm - 2.0F * e.standard_error_mm;
    const float certain_high = e.estimate_mm + 2.0F * e.standard_error_mm;
    frames_high_ =
        certain_low - e.datasheet_error_mm > limits_.replace * e.reference_mm ? frames_high_ + 1 : 0;
    frames_raised_ = certain_low > limits_.watch * e.reference_mm ? frames_raised_ + 1 : 0;
    frames_low_ = certain_high + e.datasheet_error_mm < limits_.low * e.reference_mm ? frames_low_ + 1 : 0;
  }

  Limits limits_;
  std::uint32_t hold_frames_;
  std::uint32_t frames_high_ = 0, frames_raised_ = 0, frames_low_ = 0;
  bool is_worn_ = false;
};

}  // namespace morepro
