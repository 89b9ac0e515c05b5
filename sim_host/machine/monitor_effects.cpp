#include "sim_host/machine/monitor_effects.hpp"

#include <fmt/format.h>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/monitor/configuration_check.hpp"

namespace morepro::host {
namespace {

/// What sampling does to a frame cannot be taken out of it.
bool can_be_taken_out(const gap::AppliedEffect& effect) {
  return gap::has_size(effect) && effect.form.effect != gap::Effect::kSensorQuantization &&
         gap::info_of(effect.form.effect).group != gap::EffectGroup::kSampling;
}

std::string left_out(const MachineDescription& machine, const gap::AppliedEffect& effect,
                     std::string_view why) {
  return fmt::format("machine '{}': the monitor does not know of its {}: {}", machine.name,
                     gap::name_of(effect.form.effect), why);
}

}  // namespace

void know_effects(MachineDescription& machine, std::vector<std::string>& notices) {
  MachineEffects& known = machine.configuration.effects;
  if (known.count > 0) return;
  for (const gap::AppliedEffect& effect : machine.effects) {
    if (!can_be_taken_out(effect)) continue;
    const ConfigurationResult result = check_effect(effect, machine.configuration.sampling.rate_hz);
    const bool has_room = known.count < MachineEffects::kMost;
    if (!result.ok())
      notices.push_back(left_out(machine, effect, text_of(result.error)));
    else if (!has_room)
      notices.push_back(left_out(machine, effect, text_of(ConfigurationError::kEffectCount)));
    else
      known.effect[known.count++] = effect;
  }
}

}  // namespace morepro::host
