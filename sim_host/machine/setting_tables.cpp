#include "sim_host/machine/setting_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "lib/plant/contact_law.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/setting_key.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

std::vector<std::string_view> setting_keys_of(std::string_view table) {
  std::vector<std::string_view> names;
  for (const SettingKey& key : setting_keys())
    if (key.table == table) names.push_back(key.key);
  if (table == "bank") names.push_back("rule");
  if (table == "gap") names.push_back("forms");
  return names;
}

void read_value(MachineToml& file, const toml::table& table, const SettingKey& key,
                MachineDescription& machine) {
  if (!table.contains(key.key)) return;
  const double value = file.number(table, key.table, key.key, 0.0);
  if (!is_in_range(key, value))
    file.refuse(full_name(key), fmt::format("= {} is impossible; it must be {}", value, range_text(key)));
  key.set(machine.configuration, value);
  machine.stated.insert(full_name(key));
}

void read_table(MachineToml& file, std::string_view name, MachineDescription& machine) {
  const toml::table* table = file.table(name);
  if (table == nullptr) return;
  file.check_names(*table, setting_keys_of(name), "key", fmt::format(" of [{}]", name));
  for (const SettingKey& key : setting_keys())
    if (key.table == name) read_value(file, *table, key, machine);
}

void read_rule(const MachineToml& file, MonitorConfiguration& configuration) {
  const toml::node* node = file.table("bank")->get("rule");
  if (node == nullptr) return;
  const auto rule = node->value<std::string>();
  const auto found = std::find(kRuleNames.begin(), kRuleNames.end(), rule.value_or(""));
  if (!node->is_string() || found == kRuleNames.end())
    throw UserError(
        file.place(node->source()),
        fmt::format("bank.rule is neither \"markov\" nor \"bayesian\" nor \"thesis\"{}; write one of them",
                    did_you_mean(rule.value_or(""), kRuleNames)));
  configuration.rule = static_cast<DecisionRule>(found - kRuleNames.begin());
}

std::string law_text(const MachineParameters& machine) {
  return fmt::format("with {} teeth it holds for {:.4g} .. {:.4g} mm", machine.tool.teeth,
                     ContactRange::kLowestFeed / machine.tool.teeth,
                     ContactRange::kHighestFeed / machine.tool.teeth);
}

void check_grid(const MachineToml& file, const MonitorConfiguration& configuration) {
  const auto& machine = configuration.machine;
  const HypothesisGrid& grid = configuration.grid;
  if (!is_inside_contact_range(machine, grid.first_mm))
    file.refuse("bank.first_hypothesis_mm", fmt::format("= {} is outside the consistent contact law; {}",
                                                        grid.first_mm, law_text(machine)));
  const double last_mm = grid.value_mm(grid.count - 1);
  if (!is_inside_contact_range(machine, last_mm))
    file.refuse("bank.hypotheses",
                fmt::format("= {}: the last one, {:.4g} mm, is outside the consistent contact law; {}: "
                            "take fewer or a smaller step",
                            grid.count, last_mm, law_text(machine)));
}

/// As many as the law has room for.
std::uint32_t most_hypotheses(const MachineParameters& machine, const HypothesisGrid& grid) {
  std::uint32_t count = 1;
  while (count < kMonitorHypotheses && is_inside_contact_range(machine, grid.value_mm(count))) ++count;
  return count;
}

/// Without a contact law there is no chip load to tell apart; [bank] alone may stay in the file.
void refuse_stated_bank(const MachineToml& file, const MachineDescription& machine) {
  for (const SettingKey& key : setting_keys())
    if (key.table == "bank" && machine.stated.contains(full_name(key)))
      file.refuse(full_name(key), "needs [tool] and [contact]; describe them, or remove it");
}

void read_bank(MachineToml& file, MachineDescription& machine) {
  MonitorConfiguration& configuration = machine.configuration;
  if (machine.has_contact) configuration.grid = grid_for(configuration.machine);
  const toml::table* table = file.table("bank");
  if (table == nullptr) return;
  read_table(file, "bank", machine);
  read_rule(file, configuration);
  if (!machine.has_contact) return refuse_stated_bank(file, machine);
  if (!machine.stated.contains("bank.hypotheses"))
    configuration.grid.count = most_hypotheses(configuration.machine, configuration.grid);
  check_grid(file, configuration);
}

void check_wear(const MachineToml& file, const WearLimits& wear) {
  if (wear.replace_ratio >= wear.watch_ratio) return;
  const bool is_own = file.places().contains("wear.replace_ratio");
  file.refuse(
      is_own ? "wear.replace_ratio" : "wear.watch_ratio",
      fmt::format("makes replace_ratio = {} smaller than watch_ratio = {}; WATCH comes before REPLACE",
                  wear.replace_ratio, wear.watch_ratio));
}

}  // namespace

void read_settings(MachineToml& file, MachineDescription& machine) {
  read_bank(file, machine);
  // Process noise and drift follow from the sensors and from the hypotheses; what is stated comes after them.
  choose_tuning(machine.configuration);
  for (const std::string_view table : {"tuning", "gap", "wear"}) read_table(file, table, machine);
  check_wear(file, machine.configuration.wear);
}

}  // namespace morepro::host
