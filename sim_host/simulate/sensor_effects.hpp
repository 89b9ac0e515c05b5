#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "lib/gap/applied_effect.hpp"

namespace morepro::host {

/// The effects between the machine and its sensors' noise, stepped with the machine.
class SensorEffects {
 public:
  /// Longest delay in steps.
  static constexpr std::size_t kDelaySteps = 2500;

  SensorEffects() = default;
  /// Takes those of `effects` that belong to the sensors and have a size; step_s > 0.
  SensorEffects(std::span<const gap::AppliedEffect> effects, const gap::EffectScales<double>& scales,
                double step_s);

  [[nodiscard]] bool is_empty() const { return terms_.empty(); }
  /// Takes the signals at the end of a step.
  void step(const gap::EffectSignals<double>& signals);
  /// What the sensors show too much, since the last step.
  [[nodiscard]] const gap::Contribution<double>& error() const { return error_; }

 private:
  std::vector<gap::AppliedTerm<double, kDelaySteps>> terms_;
  gap::Contribution<double> error_;
};

}  // namespace morepro::host
