#include "sim_host/machine/machine_file_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <span>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/machine_key.hpp"
#include "sim_host/machine/setting_key.hpp"

namespace morepro::host {
namespace {

bool is_described(const MachineDescription& machine, std::string_view table) {
  if (table == "spindle") return machine.has_spindle;
  if (table == "feed") return machine.has_feed;
  if (table == "thermal") return machine.has_thermal;
  return machine.has_contact;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string parameter_tables(const MachineDescription& machine) {
  MachineParameters parameters = machine.configuration.machine;
  std::string text;
  std::string_view table;
  for (const MachineKey& key : machine_keys()) {
    if (!is_described(machine, key.table)) continue;
    if (key.table != table) text += fmt::format("\n[{}]\n", key.table);
    if (key.table == "contact" && table != "contact") {
      text += fmt::format("form = \"{}\"\n",
                          parameters.contact.form == ContactForm::kThesis ? "thesis" : "consistent");
    }
    table = key.table;
    text += fmt::format("{} = {}\n", key.key, key.of(parameters));
  }
  return text;
}

/// Kind, shape and coefficients where they are not those of every effect of that size.
std::string refinement(const gap::AppliedEffect& effect, const gap::AppliedEffect& usual) {
  std::string text;
  if (effect.form.kind != usual.form.kind) text += fmt::format("kind = {}\n", effect.form.kind);
  if (effect.form.shape != usual.form.shape) text += fmt::format("shape = {}\n", effect.form.shape);
  const bool is_usual = effect.form.parts == usual.form.parts && effect.coefficient == usual.coefficient;
  const auto end = effect.coefficient.begin() + effect.form.parts;
  if (!is_usual)
    text += fmt::format("coefficients = [{}]\n", fmt::join(effect.coefficient.begin(), end, ", "));
  return text;
}

template <typename Settings>
std::string settings_table(std::string_view name, std::span<const SettingKey<Settings>> keys,
                           Settings settings) {
  std::string text = fmt::format("\n[{}]\n", name);
  for (const SettingKey<Settings>& key : keys) text += fmt::format("{} = {}\n", key.key, key.of(settings));
  return text;
}

std::string effect_table(const gap::AppliedEffect& effect, const MachineParameters& machine) {
  const gap::EffectScales<double> scales(machine, {});
  const double size = gap::size_of(effect, scales);
  std::string text = fmt::format("\n[[effects]]\nname = \"{}\"\n", gap::name_of(effect.form.effect));
  text += gap::size_is_shape(effect.form.effect) ? fmt::format("size = {}\n", effect.form.shape)
                                                 : fmt::format("size = {}\n", size);
  text += refinement(effect, gap::applied(effect.form.effect, size, scales));
  if (effect.onset_s != 0.0) text += fmt::format("onset_s = {}\n", effect.onset_s);
  return text;
}

}  // namespace

std::string machine_file_text(const MachineDescription& machine) {
  std::string text = fmt::format("[machine]\nname = {}\n", quoted(machine.name));
  text += parameter_tables(machine);
  if (machine.has_contact) text += settings_table("wear", wear_keys(), machine.configuration.wear);
  text += fmt::format("\n[sampling]\nrate_hz = {}\n", machine.configuration.sampling.rate_hz);
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const SensorNoise& sensor = machine.configuration.sensors[static_cast<Channel>(i)];
    if (!(sensor.variance() > 0.0)) continue;
    text +=
        fmt::format("\n[sensors.{}]\nnoise = {}\nlsb = {}\n", kChannels[i].column, sensor.noise, sensor.lsb);
  }
  if (machine.has_gap) text += settings_table("gap", gap_keys(), machine.configuration.gap);
  for (const gap::AppliedEffect& effect : machine.effects)
    text += effect_table(effect, machine.configuration.machine);
  return text;
}

std::string estimator_comments(const MachineDescription& machine) {
  MonitorConfiguration chosen = machine.configuration;
  if (machine.is_built_in) choose_estimators(chosen, machine.has_contact);
  const FilterTuning& own = machine.configuration.tuning;
  const FilterTuning& tuning = chosen.tuning;
  std::string text = "\n# Chosen from the above:\n";
  const auto add = [&text](std::string_view name, auto value) {
    text += fmt::format("# {} = {}\n", name, value);
  };
  const auto add_tuned = [&text, &machine](std::string_view name, double value, double built_in) {
    const bool is_other = std::fabs(value - built_in) > 1e-9 * value;
    text += fmt::format("# {} = {}", name, value);
    text += is_other ? fmt::format(" (--machine {}: {})\n", machine.name, built_in) : "\n";
  };
  add("hypotheses", chosen.grid.count);
  add("first_hypothesis_mm", chosen.grid.first_mm);
  add("hypothesis_step_mm", chosen.grid.step_mm);
  add_tuned("speed_process_noise_rad_s", tuning.speed_process_noise_rad_s, own.speed_process_noise_rad_s);
  add_tuned("current_process_noise_a", tuning.current_process_noise_a, own.current_process_noise_a);
  add_tuned("feed_process_noise_m_s", tuning.feed_process_noise_m_s, own.feed_process_noise_m_s);
  add_tuned("chip_load_drift_mm", tuning.chip_load_drift_mm, own.chip_load_drift_mm);
  add("switch_probability", tuning.switch_probability);
  add("parameter_start_fraction", tuning.parameter_start_fraction);
  for (const GapKey& key : gap_keys()) add(fmt::format("gap.{}", key.key), key.of(chosen.gap));
  return text;
}

}  // namespace morepro::host
