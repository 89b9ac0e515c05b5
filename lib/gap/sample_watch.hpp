#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/gap_frame.hpp"
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/gap/repeated_frames.hpp"
#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// Do the samples of a sensor come in steps? Then what they change by, and how that changes from frame to
/// frame, are multiples of the least one, and that is the step. The former is the same from frame to frame
/// for all that moves evenly, in steps or not, so the latter is looked at.
template <class Real>
class StepWatch {
 public:
  /// Samples of three frames that follow each other, the last one first.
  void see(Real value, Real before, Real earlier) {
    const Real change = math::abs((value - before) - (before - earlier));
    const Real rounding = kRounding * (math::abs(value) + math::abs(before) + math::abs(earlier));
    if (!(change > Real(2) * rounding)) return;
    if (seen_ == 0 || change < kSmaller * least_) begin(change);
    const Real steps = change / least_;
    const Real tolerance = kTolerance + Real(2) * rounding / least_;
    const bool fits =
        steps < kMostSteps && tolerance < kNoTolerance && math::abs(steps - nearest(steps)) < tolerance;
    ++seen_;
    if (fits) ++fitting_;
    if (seen_ == kChanges) conclude();
  }

  /// Takes what another one has seen of the same sensor.
  void merge(const StepWatch& other) {
    step_ = std::max(step_, other.step_);
    is_known_ |= other.is_known_;
  }

  /// Of the last changes; 0: none, or not known yet.
  [[nodiscard]] Real step() const { return step_; }
  [[nodiscard]] bool is_fine() const { return is_known_ && step_ == Real(0); }

 private:
  static constexpr std::uint16_t kChanges = 256;
  static constexpr Real kRounding = Real(4.0e-7);  // of recordings with seven digits, and of floats
  static constexpr Real kSmaller = Real(0.9);
  static constexpr Real kTolerance = Real(0.05);
  static constexpr Real kNoTolerance = Real(0.25);  // every other number fits
  static constexpr Real kMostSteps = Real(1.0e6);   // as a whole number

  static Real nearest(Real steps) { return static_cast<Real>(static_cast<int>(steps + Real(0.5))); }

  void begin(Real change) {
    least_ = change;
    seen_ = fitting_ = 0;
  }

  void conclude() {
    step_ = 20U * fitting_ >= 19U * kChanges ? least_ : Real(0);
    is_known_ = true;
    begin(Real(0));
  }

  Real least_ = 0;
  Real step_ = 0;
  std::uint16_t seen_ = 0;
  std::uint16_t fitting_ = 0;
  bool is_known_ = false;
};

/// Faults of the acquisition, which stand in the samples themselves: steps that are coarser than the
/// sensor's, frames that are lost or show the one before once more.
template <class Real>
class SampleWatch {
 public:
  explicit SampleWatch(const SampleLimits& limits)
      : limit_{limits.speed_step_rad_s, limits.current_step_a, limits.feed_step_m_s, limits.position_step_m},
        lost_limit_(limits.lost_share) {}

  /// What comes next does not follow.
  void end() { repeated_.end(); }
  /// Frames came, whether anybody looked into them or not.
  void count(std::size_t frames) {
    frames_ += static_cast<std::uint32_t>(frames);
    if (frames_ < kMostFrames) return;
    frames_ /= 2;
    lost_ /= 2;
    repeated_.fade();
  }
  /// Frames did not come.
  void lose(std::uint32_t frames) {
    lost_ += frames;
    frames_ += frames;
  }

  /// Three frames that follow each other, the last one first. Small instead of fast: a stretch in a second is
  /// looked into.
  [[gnu::noinline, gnu::cold]] void see(const GapFrame<Real>& frame, const GapFrame<Real>& before,
                                        const GapFrame<Real>& earlier) {
    SameSensors sensors;
    for (std::size_t k = 0; k < kSensors; ++k) {
      if (!(frame.*kHas[k]) || !(before.*kHas[k]) || !(earlier.*kHas[k])) continue;
      steps_[k].see(frame.*kValue[k], before.*kValue[k], earlier.*kValue[k]);
      sensors.add(k, frame.*kValue[k] == before.*kValue[k]);
      sensors.is_as_before_last &= frame.*kValue[k] == earlier.*kValue[k];
    }
    if (is_one_feed_sensor()) sensors.join(kFeedSpeed, kFeedPosition);
    repeated_.see(sensors);
  }

  void merge(const SampleWatch& other) {
    for (std::size_t k = 0; k < kSensors; ++k) steps_[k].merge(other.steps_[k]);
    frames_ += other.frames_;
    lost_ += other.lost_;
    repeated_.merge(other.repeated_);
  }

  /// kEffect, or kNotEnoughData where there is no fault.
  [[nodiscard]] GapFinding finding() const {
    GapFinding found;
    const bool is_coarse = has_coarse_steps();
    if (!is_coarse && !loses_frames()) return found;
    found.verdict = GapVerdict::kEffect;
    found.effect = is_coarse ? Effect::kSensorQuantization : Effect::kSampleDropout;
    found.where = group_of(found.effect);
    found.confidence = kConfidence;
    found.evidence = kCertain;
    return found;
  }

 private:
  static constexpr std::uint32_t kFewestFrames = 300;
  static constexpr std::uint32_t kMostFrames = 1U << 24U;  // as floats
  static constexpr float kConfidence = 0.97F;
  static constexpr float kCertain = 1.0e4F;  // what stands in the samples is not a matter of chance

  static constexpr std::size_t kSensors = SameSensors::kMost;
  static constexpr std::size_t kFeedSpeed = 2;
  static constexpr std::size_t kFeedPosition = 3;
  static constexpr std::array<Real GapFrame<Real>::*, kSensors> kValue{
      &GapFrame<Real>::speed_rad_s, &GapFrame<Real>::current_a, &GapFrame<Real>::feed_speed_m_s,
      &GapFrame<Real>::feed_position_m};
  static constexpr std::array<bool GapFrame<Real>::*, kSensors> kHas{
      &GapFrame<Real>::has_speed, &GapFrame<Real>::has_current, &GapFrame<Real>::has_feed_speed,
      &GapFrame<Real>::has_feed_position};

  [[nodiscard]] bool has_coarse_steps() const {
    bool is_coarse = false;
    for (std::size_t k = 0; k < kSensors; ++k)
      is_coarse |= limit_[k] > Real(0) && steps_[k].step() > limit_[k];
    return is_coarse;
  }

  [[nodiscard]] bool loses_frames() const {
    if (frames_ < kFewestFrames || !(lost_limit_ > Real(0))) return false;
    const Real missing = static_cast<Real>(lost_) / static_cast<Real>(frames_);
    return missing + repeated_.lost_share() > lost_limit_;
  }

  /// A speed in steps may be the difference of a position in steps.
  [[nodiscard]] bool is_one_feed_sensor() const {
    return !steps_[kFeedSpeed].is_fine() && !steps_[kFeedPosition].is_fine();
  }

  std::array<StepWatch<Real>, kSensors> steps_{};
  std::array<Real, kSensors> limit_;
  Real lost_limit_;
  RepeatedFrames<Real> repeated_;
  std::uint32_t frames_ = 0;
  std::uint32_t lost_ = 0;
};

}  // namespace morepro::gap
