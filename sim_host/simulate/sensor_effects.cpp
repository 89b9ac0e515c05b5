#include "sim_host/simulate/sensor_effects.hpp"

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/simulate/state_effects.hpp"

namespace morepro::host {

SensorEffects::SensorEffects(std::span<const gap::AppliedEffect> effects,
                             const gap::EffectScales<double>& scales, double step_s) {
  for (const gap::AppliedEffect& effect : effects) {
    if (gap::info_of(effect.form.effect).group == gap::EffectGroup::kSensor && gap::has_size(effect))
      terms_.emplace_back(effect, scales, step_s);
  }
}

void SensorEffects::step(const gap::EffectSignals<double>& signals) {
  error_ = {};
  for (auto& term : terms_) term.step(signals, error_);
}

}  // namespace morepro::host
