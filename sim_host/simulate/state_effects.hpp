#pragma once
#include <span>
#include <vector>

#include "lib/gap/applied_effect.hpp"
#include "lib/plant/plant_state.hpp"

namespace morepro::host {

/// The effects that act on the machine itself, stepped with its sub-steps.
class StateEffects {
 public:
  StateEffects() = default;
  /// Takes those of `effects` that belong to a balance and have a size; step_s > 0.
  StateEffects(std::span<const gap::AppliedEffect> effects, const gap::EffectScales<double>& scales,
               double step_s);

  [[nodiscard]] bool is_empty() const { return terms_.empty(); }
  /// What they add to the state's derivatives, mean over one step whose middle is `signals`.
  PlantDerivative<double> step(const gap::EffectSignals<double>& signals);
  /// What they would add at `signals`.
  [[nodiscard]] PlantDerivative<double> at(const gap::EffectSignals<double>& signals) const;

 private:
  using Term = gap::AppliedTerm<double, 0>;

  gap::EffectScales<double> scales_;
  std::vector<Term> terms_;
};

}  // namespace morepro::host
