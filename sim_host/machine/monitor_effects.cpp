#include "sim_host/machine/monitor_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

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

/// Drops the forms that a monitor cannot hold at this rate: delays are in samples there.
void keep_possible_forms(MachineDescription& machine, gap::MachineForms& forms,
                         std::vector<std::string>& notices) {
  const gap::MachineForms stated = std::exchange(forms, {});
  for (std::size_t i = 0; i < stated.count; ++i) {
    const gap::AppliedEffect effect{.form = stated.form[i]};
    const ConfigurationResult result = check_effect(effect, machine.configuration.sampling.rate_hz);
    if (result.ok() || effect.form.parts == 0)
      forms.form[forms.count++] = stated.form[i];
    else
      notices.push_back(fmt::format("machine '{}': the monitor looks for its own form of {}: {}",
                                    machine.name, gap::name_of(effect.form.effect), text_of(result.error)));
  }
}

/// What its link is known to lose and its clock to shake by is no fault of the machine.
void know_sampling(const std::vector<gap::AppliedEffect>& effects, GapTuning& gap) {
  constexpr double kMore = 1.5;  // a link loses more at times
  for (const gap::AppliedEffect& effect : effects) {
    const double size = effect.coefficient[0];
    if (effect.form.effect == gap::Effect::kSampleDropout && gap.lost_share > 0.0)
      gap.lost_share = std::max(gap.lost_share, std::min(kMore * size, 1.0));
    if (effect.form.effect == gap::Effect::kClockJitter)
      gap.clock_jitter_s = std::max(gap.clock_jitter_s, size);
  }
}

}  // namespace

void know_effects(MachineDescription& machine, std::vector<std::string>& notices) {
  keep_possible_forms(machine, machine.configuration.gap.spindle.forms, notices);
  keep_possible_forms(machine, machine.configuration.gap.feed.forms, notices);
  know_sampling(machine.effects, machine.configuration.gap);
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
