#pragma once
#include <cstdint>
#include <span>

#include "lib/gap/applied_effect.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {

/// What happens when and as the signals are read: rounding, jitter of the clock, lost rows.
class SamplingEffects {
 public:
  SamplingEffects(std::span<const gap::AppliedEffect> effects, std::uint64_t seed);

  /// Draws for the sample that is due at this time of the run.
  void next(std::uint64_t index, double time_s);

  [[nodiscard]] double late_s() const { return late_s_; }
  /// Last bits, or standard deviations, that one step of the sensors is wide; 0: they are as described.
  [[nodiscard]] double quantization() const { return quantization_; }
  [[nodiscard]] bool is_lost() const { return is_lost_; }

 private:
  struct Source {
    double size = 0.0;
    double onset_s = 0.0;
    [[nodiscard]] double at(double time_s) const { return time_s >= onset_s ? size : 0.0; }
  };
  [[nodiscard]] static Source source(std::span<const gap::AppliedEffect> effects, gap::Effect effect);

  Source quantum_;
  Source jitter_;
  Source dropout_;
  NormalNumbers clock_;
  std::uint64_t dropout_seed_;
  double late_s_ = 0.0;
  double quantization_ = 0.0;
  bool is_lost_ = false;
};

}  // namespace morepro::host
