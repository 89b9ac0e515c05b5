#include "sim_host/machine/machine_file_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

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

std::string toml_string(std::string_view text) {
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

/// One line of [bank], [tuning], [gap] or [wear].
std::string setting_line(const SettingKey& key, double value) {
  return fmt::format("{} = {}\n", key.key, value);
}

bool is_used(const MachineDescription& machine, const SettingKey& key) {
  return key.part.empty() || is_described(machine, key.part);
}

/// A setting that the machine does not state: nothing in a machine file, because a changed sensor changes it.
/// For `config` a comment with the value that is chosen.
class Unstated {
 public:
  Unstated(const MachineDescription& machine, bool is_shown) : is_shown_(is_shown), machine_(machine) {
    if (is_shown && machine.is_built_in) chosen_ = chosen_for(machine.configuration, machine.has_contact);
  }

  [[nodiscard]] std::string line(const SettingKey& key) const {
    if (!is_shown_) return {};
    const double own = key.get(machine_.configuration);
    const double value = machine_.is_built_in ? key.get(chosen_) : own;
    const std::string text = fmt::format("# {} = {}  # {}", key.key, value, key.origin);
    const bool is_tuned = std::fabs(value - own) > 1e-9 * value;
    return is_tuned ? fmt::format("{} (--machine {}: {})\n", text, machine_.name, own) : text + '\n';
  }

  /// The rule is always stated; who looks for settings wants to know the others.
  [[nodiscard]] std::string with_rule(DecisionRule rule) const {
    return fmt::format("rule = \"{}\"{}\n", kRuleNames.at(static_cast<std::size_t>(rule)),
                       is_shown_ ? fmt::format("  # one of {}", fmt::join(kRuleNames, ", ")) : "");
  }

 private:
  bool is_shown_;
  const MachineDescription& machine_;
  MonitorConfiguration chosen_;
};

std::string settings_table(std::string_view table, const MachineDescription& machine,
                           const Unstated& unstated) {
  std::string text;
  for (const SettingKey& key : setting_keys()) {
    const bool is_stated = machine.stated.contains(full_name(key));
    if (key.table != table || !(is_stated || is_used(machine, key))) continue;
    const bool is_fixed = is_stated || key.origin.empty();
    text += is_fixed ? setting_line(key, key.get(machine.configuration)) : unstated.line(key);
  }
  if (table == "bank" && machine.has_contact) text += unstated.with_rule(machine.configuration.rule);
  return text.empty() ? text : fmt::format("\n[{}]\n{}", table, text);
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

std::string form_tables(const gap::MachineForms& forms) {
  std::string text;
  for (std::size_t i = 0; i < forms.count; ++i) {
    const gap::EffectForm& form = forms.form[i];
    text +=
        fmt::format("\n[[gap.forms]]\nname = \"{}\"\nparts = {}\n", gap::name_of(form.effect), form.parts);
    if (form.kind != 0) text += fmt::format("kind = {}\n", form.kind);
    if (form.shape != 0.0F) text += fmt::format("shape = {}\n", form.shape);
  }
  return text;
}

std::string sensor_tables(const Sensors& sensors) {
  std::string text;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const SensorNoise& sensor = sensors[static_cast<Channel>(i)];
    if (!(sensor.variance() > 0.0)) continue;
    text +=
        fmt::format("\n[sensors.{}]\nnoise = {}\nlsb = {}\n", kChannels[i].column, sensor.noise, sensor.lsb);
  }
  return text;
}

std::string text_of(const MachineDescription& machine, std::string_view words, const Unstated& unstated) {
  std::string text = fmt::format("[machine]\nname = {}\n", toml_string(machine.name));
  text += parameter_tables(machine);
  text += fmt::format("\n[sampling]\nrate_hz = {}\n", machine.configuration.sampling.rate_hz);
  text += sensor_tables(machine.configuration.sensors);
  text += words;
  for (const std::string_view table : {"bank", "tuning", "gap", "wear"})
    text += settings_table(table, machine, unstated);
  for (const gap::MachineForms& forms :
       {machine.configuration.gap.spindle.forms, machine.configuration.gap.feed.forms})
    text += form_tables(forms);
  for (const gap::AppliedEffect& effect : machine.effects)
    text += effect_table(effect, machine.configuration.machine);
  return text;
}

constexpr std::string_view kWords =
    "\n# What begins with # below is chosen from the tables above, as stands behind the second #; it follows"
    "\n# them. Remove the first # to state a value of your own, per sample at the rate of [sampling].\n";

}  // namespace

std::string machine_file_text(const MachineDescription& machine) {
  return text_of(machine, "", Unstated(machine, false));
}

std::string config_text(const MachineDescription& machine) {
  return text_of(machine, kWords, Unstated(machine, true));
}

}  // namespace morepro::host
