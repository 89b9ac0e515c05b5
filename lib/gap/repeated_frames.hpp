#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// Sensors of two frames that follow each other: those that both have, and those among them that show the
/// same.
struct SameSensors {
  static constexpr std::size_t kMost = 4;
  std::uint8_t measured = 0;  ///< bit k: sensor k
  std::uint8_t same = 0;
  bool is_as_before_last = true;  ///< do all show the same as in the frame before the last one?

  void add(std::size_t sensor, bool is_same) {
    measured = static_cast<std::uint8_t>(measured | 1U << sensor);
    if (is_same) same = static_cast<std::uint8_t>(same | 1U << sensor);
  }
  /// One of two that show the same thing, a speed that is the difference of a position: they are one witness.
  void join(std::size_t sensor, std::size_t other) {
    if ((measured >> sensor & measured >> other & 1U) == 0) return;
    const unsigned both = same >> sensor & same >> other & 1U;
    const unsigned neither = ~(1U << sensor | 1U << other);
    measured = static_cast<std::uint8_t>(measured & ~(1U << other));
    same = static_cast<std::uint8_t>((same & neither) | both << sensor);
  }
  /// Does the frame repeat the other one? One sensor alone may stand still.
  [[nodiscard]] bool are_all() const {
    const bool is_one = (measured & (measured - 1)) == 0;
    return same == measured && !is_one;
  }
};

/// One of the frames that are kept.
struct SeenFrame {
  SameSensors sensors;
  bool is_at_standstill = false;  ///< all have been the same for longer than a link loses frames
};

/// Frames before one, and frames after it, that tell what chance makes there.
inline constexpr int kFramesBeside = 16;

/// Some frames in a row: in how many of them which sensors show the same as in the frame before.
class FramesInARow {
 public:
  void add(const SeenFrame& frame) { count(frame, 1); }
  void remove(const SeenFrame& frame) { count(frame, -1); }

  /// Does the machine rest? Then all sensors are often the same, and not only together, or they stay so.
  [[nodiscard]] bool are_at_rest(unsigned measured) const {
    constexpr int kOften = 6;  // of kFramesBeside
    int least = kOften;
    for (std::size_t k = 0; k < SameSensors::kMost; ++k)
      if ((measured >> k & 1U) != 0 && same_[k] < least) least = same_[k];
    return still_ > 0 || (least >= kOften && have_one_alone(measured));
  }
  /// Is a sensor the same where not all are?
  [[nodiscard]] bool have_one_alone(unsigned measured) const {
    int alone = 0;
    for (std::size_t k = 0; k < SameSensors::kMost; ++k)
      if ((measured >> k & 1U) != 0) alone += same_[k] - all_;
    return alone > 0;
  }

  /// Share of the frames that were not lost, of these and `others`, in which all sensors show the same by
  /// chance: of each the share of the frames in which not all others do so, since none of these was lost.
  template <class Real>
  [[nodiscard]] Real all_by_chance(const FramesInARow& others, unsigned measured) const {
    Real share = Real(1);
    const int all = all_ + others.all_;
    for (std::size_t k = 0; k < SameSensors::kMost; ++k) {
      if ((measured >> k & 1U) == 0) continue;
      const int seen = frames_ + others.frames_ - all - all_others_[k] - others.all_others_[k];
      if (seen <= 0) return Real(1);
      share *= static_cast<Real>(same_[k] + others.same_[k] - all) / static_cast<Real>(seen);
    }
    return share;
  }

 private:
  using Count = std::uint8_t;

  void count(const SeenFrame& seen, int by) {
    const auto change = [by](Count& counted, bool is_one) {
      counted = static_cast<Count>(counted + (is_one ? by : 0));
    };
    const SameSensors& frame = seen.sensors;
    change(frames_, true);
    change(all_, frame.are_all());
    change(still_, seen.is_at_standstill);
    for (std::size_t k = 0; k < SameSensors::kMost; ++k) {
      const unsigned own = 1U << k;
      const bool is_same = (frame.same & own) != 0;
      change(same_[k], is_same);
      change(all_others_[k], !is_same && (frame.same | own) == frame.measured);
    }
  }

  Count frames_ = 0;
  Count all_ = 0;    ///< in which all sensors are the same
  Count still_ = 0;  ///< and have been for long
  std::array<Count, SameSensors::kMost> same_{};
  std::array<Count, SameSensors::kMost> all_others_{};  ///< but not this one
};

/// Frames that show the one before once more. Sensors in steps repeat themselves by chance, each by itself;
/// what all of them do at once more often than that, the link did. How often by chance, and whether the
/// machine rests, when all of them do so together, is seen from the frames before and after. Where a motion
/// turns they do so together, too, but then they are as often the same as in the frame before the last one.
template <class Real>
class RepeatedFrames {
 public:
  /// A machine at rest shows the same for longer.
  static constexpr std::uint32_t kLongestRun = 8;

  /// One frame against the one before. Was the one `kFramesBeside` before it a repeated one, as far as that
  /// can be told?
  bool see(const SameSensors& sensors) {
    if (sensors.measured != measured_) end();
    measured_ = sensors.measured;
    run_ = sensors.are_all() ? run_ + 1 : 0;
    if (seen_ == kFrames) before_.remove(back(2 * kBeside));
    if (seen_ > kBeside) before_.add(back(kBeside));
    if (seen_ >= kBeside) after_.remove(back(kBeside - 1));
    newest_ = static_cast<std::uint8_t>(newest_ + 1U == kFrames ? 0U : newest_ + 1U);
    frame_[newest_] = {sensors, run_ > kLongestRun};
    after_.add(frame_[newest_]);
    if (seen_ < kFrames) ++seen_;
    return seen_ == kFrames && judge(back(kBeside));
  }
  /// What comes next does not follow.
  void end() {
    before_ = after_ = {};
    seen_ = 0;
    run_ = 0;
  }

  void merge(const RepeatedFrames& other) {
    counted_ += other.counted_;
    repeated_ += other.repeated_;
    as_before_last_ += other.as_before_last_;
    by_chance_ += other.by_chance_;
  }
  void fade() {
    counted_ *= Real(0.5);
    repeated_ *= Real(0.5);
    as_before_last_ *= Real(0.5);
    by_chance_ *= Real(0.5);
  }

  /// Share of the frames that was lost, 0 .. 1; 0 where so many may be chance, which is not known better than
  /// to its half, or a motion that turns. Sensors in coarse steps that turn together within a frame or two
  /// are the same then in up to 0.6 % of all frames.
  [[nodiscard]] Real lost_share() const {
    constexpr Real kFine = Real(1.0e-4);
    constexpr Real kLeastOfCoarse = Real(0.0075);
    const Real lost = repeated_ - by_chance_;
    const bool is_more =
        is_beyond(repeated_, Real(2) * by_chance_) && is_beyond(repeated_, Real(1.5) * as_before_last_);
    const bool is_enough = by_chance_ < kFine * counted_ || lost > kLeastOfCoarse * counted_;
    return is_more && is_enough ? lost / counted_ : Real(0);
  }

 private:
  static constexpr std::uint32_t kBeside = kFramesBeside;
  static constexpr std::uint32_t kFrames = 2 * kBeside + 1;

  [[nodiscard]] const SeenFrame& back(std::uint32_t frames) const {
    return frame_[newest_ >= frames ? newest_ - frames : newest_ + kFrames - frames];
  }

  static bool is_beyond(Real count, Real expected) {
    constexpr Real kDeviations = Real(5);
    return count > expected + kDeviations * math::sqrt(expected + Real(1));
  }

  bool judge(const SeenFrame& frame) {
    if (before_.are_at_rest(measured_) || after_.are_at_rest(measured_)) return false;
    const Real chance = before_.template all_by_chance<Real>(after_, measured_);
    if (!(chance < Real(1))) return false;
    counted_ += Real(1);
    by_chance_ += chance;
    const bool have_one_alone = before_.have_one_alone(measured_) || after_.have_one_alone(measured_);
    if (have_one_alone && frame.sensors.is_as_before_last) as_before_last_ += Real(1);
    if (!frame.sensors.are_all()) return false;
    repeated_ += Real(1);
    return true;
  }

  std::array<SeenFrame, kFrames> frame_{};
  FramesInARow before_;
  FramesInARow after_;
  std::uint8_t newest_ = 0;
  std::uint8_t seen_ = 0;
  std::uint8_t measured_ = 0;
  std::uint32_t run_ = 0;
  Real counted_ = 0;
  Real repeated_ = 0;
  Real as_before_last_ = 0;  ///< where sensors repeat themselves by chance
  Real by_chance_ = 0;
};

}  // namespace morepro::gap
