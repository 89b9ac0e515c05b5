#include "sim_host/simulate/state_effects.hpp"

#include "lib/gap/effect_catalogue.hpp"

namespace morepro::host {
namespace {

bool acts_on_state(const gap::AppliedEffect& effect) {
  switch (gap::info_of(effect.form.effect).group) {
    case gap::EffectGroup::kSpindleTorque:
    case gap::EffectGroup::kFeedForce:
    case gap::EffectGroup::kArmatureVoltage:
      return true;
    case gap::EffectGroup::kSensor:
    case gap::EffectGroup::kSampling:
      return false;
  }
  return false;
}

}  // namespace

StateEffects::StateEffects(std::span<const gap::AppliedEffect> effects,
                           const gap::EffectScales<double>& scales, double step_s)
    : scales_(scales) {
  for (const gap::AppliedEffect& effect : effects) {
    if (acts_on_state(effect) && gap::has_size(effect)) terms_.emplace_back(effect, scales, step_s);
  }
}

PlantDerivative<double> StateEffects::step(const gap::EffectSignals<double>& signals) {
  gap::Contribution<double> sum;
  for (Term& term : terms_) term.step(signals, sum);
  return {sum.torque_nm / scales_.inertia_kgm2, sum.force_n / scales_.mass_kg,
          sum.voltage_v / scales_.inductance_h};
}

PlantDerivative<double> StateEffects::at(const gap::EffectSignals<double>& signals) const {
  return StateEffects(*this).step(signals);
}

}  // namespace morepro::host
