#include "sim_host/machine/machine_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/monitor/configuration_check.hpp"
#include "sim_host/machine/machine_rules.hpp"
#include "sim_host/support/parsed_toml.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {

MachineToml::MachineToml(const std::string& path) : path_(path), root_(parsed_toml(path)) {}

TextPlace MachineToml::place(const toml::source_region& source) const {
  return {path_, source.begin.line, source.begin.column};
}

const toml::table* MachineToml::table(std::string_view name) const {
  const toml::node* node = root_.get(name);
  if (node == nullptr) return nullptr;
  if (const toml::table* table = node->as_table()) return table;
  throw UserError(place(node->source()), fmt::format("'{0}' is no table; write [{0}] above its keys", name));
}

void MachineToml::check_names(const toml::table& table, std::span<const std::string_view> known,
                              std::string_view kind, std::string_view where) const {
  for (auto&& [key, node] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw UserError(place(key.source()), fmt::format("{} '{}'{} is not known{}; correct or remove it", kind,
                                                     key.str(), where, did_you_mean(key.str(), known)));
  }
}

double MachineToml::number(const toml::table& table, std::string_view table_name, std::string_view key,
                           double fallback) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return fallback;
  const std::string name = fmt::format("{}.{}", table_name, key);
  places_[name] = place(node->source());
  const auto value = node->value<double>();
  if (!node->is_number() || !value) refuse(name, "is no number; write a number without quotes and unit");
  if (!std::isfinite(*value)) refuse(name, "is not finite; write the machine's value");
  if (!has_possible_magnitude(*value, detail::kLargest)) refuse_magnitude(name, *value);
  return *value;
}

void MachineToml::refuse(const std::string& name, std::string_view sentence) const {
  throw UserError(places_.at(name), fmt::format("{} {}", name, sentence));
}

void MachineToml::refuse_magnitude(const std::string& name, double value) const {
  refuse(name, fmt::format("= {:g} has a magnitude that no machine has; check its unit", value));
}

}  // namespace morepro::host
