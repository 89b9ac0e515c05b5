#pragma once
#include <cstdint>

namespace morepro {

/// Mean of the normalised innovation squared per degree of freedom over the last frames: 1 where the model,
/// its noise included, is right. A plain mean until it has kMemory frames, exponentially forgetting from then
/// on.
class RunningRatio {
 public:
  static constexpr std::uint32_t kMemory = 512;

  void step(float nis, std::uint32_t degrees_of_freedom) {
    if (degrees_of_freedom == 0) return;
    if (frames_ < kMemory) ++frames_;
    const float ratio = nis / static_cast<float>(degrees_of_freedom);
    value_ += (ratio - value_) / static_cast<float>(frames_);
  }

  [[nodiscard]] float value() const { return value_; }
  [[nodiscard]] bool is_settled() const { return frames_ >= kMemory; }

 private:
  float value_ = 0.0F;
  std::uint32_t frames_ = 0;
};

}  // namespace morepro
