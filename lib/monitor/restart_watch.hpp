#pragma once
#include <cstdint>

namespace morepro {

/// Counts how often the state of one axis had to start again because its prediction lost the measurement.
/// Once is an accident; again and again within a short time, the model is wrong.
class RestartWatch {
 public:
  /// Once per frame of that axis.
  void step(bool restarted) {
    if (frames_since_ < kMemory)
      ++frames_since_;
    else
      restarts_ = 0;
    if (!restarted) return;
    frames_since_ = 0;
    if (restarts_ < kMany) ++restarts_;
  }

  [[nodiscard]] bool are_many() const { return restarts_ >= kMany; }

 private:
  static constexpr std::uint32_t kMany = 4;
  static constexpr std::uint32_t kMemory = 5000;

  std::uint32_t restarts_ = 0;
  std::uint32_t frames_since_ = 0;
};

}  // namespace morepro
