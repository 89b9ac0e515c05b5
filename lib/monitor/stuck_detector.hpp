#pragma once
#include <cstdint>

namespace morepro {

/// Finds a sensor that stopped living: one that used to change with nearly every frame and now repeats one
/// value. A coarse sensor that has always repeated its values is not suspected; a constant reading of such a
/// one is caught by the innovation gate when the machine moves.
class StuckDetector {
 public:
  /// A value may repeat for so many frames before it counts as stuck.
  static constexpr std::uint32_t kLongestRun = 60;

  /// One frame's value; true: it is stuck.
  bool step(float value) {
    if (value == last_) {
      if (run_ < kLongestRun) ++run_;
    } else {
      end_run();
      last_ = value;
    }
    return is_stuck();
  }

 private:
  static constexpr std::uint32_t kLivelyRun = 8;        ///< longest run of a fine sensor, with room
  static constexpr std::uint32_t kChangesToKnow = 200;  ///< changes seen before anything is said

  void end_run() {
    if (!is_stuck() && run_ > longest_run_) longest_run_ = run_;
    if (changes_ < kChangesToKnow) ++changes_;
    run_ = 0;
  }

  [[nodiscard]] bool is_stuck() const { return run_ >= kLongestRun && is_lively(); }
  [[nodiscard]] bool is_lively() const { return changes_ >= kChangesToKnow && longest_run_ <= kLivelyRun; }

  float last_ = 0.0F;
  std::uint32_t run_ = 0;
  std::uint32_t longest_run_ = 0;
  std::uint32_t changes_ = 0;
};

}  // namespace morepro
