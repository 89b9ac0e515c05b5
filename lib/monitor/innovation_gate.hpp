#pragma once
#include <cstdint>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Rejects single measurements that are too far from their prediction, and notices when it is the prediction
/// that is wrong: after kPatience rejections in a row the state must start again from the measurement.
class InnovationGate {
 public:
  static constexpr float kSigmas = 8.0F;
  static constexpr std::uint32_t kPatience = 5;

  /// One measurement. `predicted_change`: what the model expects to change within the period; it is allowed
  /// on top, so that a model whose datasheet is wrong is not taken for a broken sensor. True: do not use it.
  bool rejects(float innovation, float variance, float predicted_change) {
    const float excess = math::abs(innovation) - math::abs(predicted_change);
    const bool is_far = !(excess <= 0.0F || excess * excess <= kSigmas * kSigmas * variance);
    rejected_ = is_far ? rejected_ + 1 : 0;
    return is_far;
  }

  [[nodiscard]] bool has_lost_the_state() const { return rejected_ >= kPatience; }
  void restart() { rejected_ = 0; }

 private:
  std::uint32_t rejected_ = 0;
};

}  // namespace morepro
