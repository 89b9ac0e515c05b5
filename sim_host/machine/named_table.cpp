#include "sim_host/machine/named_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {

void NamedTable::refuse(std::string_view key, const std::string& sentence) const {
  const toml::node* node = table_.get(key);
  const auto source = (node == nullptr ? table_ : *node).source().begin;
  throw UserError({path_, source.line, source.column}, fmt::format("{}.{}: {}", list_, key, sentence));
}

void NamedTable::check_keys(std::span<const std::string_view> known) const {
  for (auto&& [key, node] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    refuse(key.str(),
           fmt::format("this key is not known{}; correct or remove it", did_you_mean(key.str(), known)));
  }
}

gap::Effect NamedTable::effect() const {
  const auto name = table_["name"].value<std::string>();
  if (!name) refuse("name", fmt::format("every [[{}]] needs the name of an effect between quotes", list_));
  if (const auto effect = gap::effect_named(*name)) return *effect;
  std::vector<std::string_view> names;
  for (const gap::EffectInfo& info : gap::kEffects) names.push_back(info.name);
  refuse("name", fmt::format("no effect is called '{}'{}; 'morepro effects' lists them", *name,
                             did_you_mean(*name, names)));
}

double NamedTable::number(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) refuse(key, fmt::format("every [[{}]] needs its {}; add it", list_, key));
  return finite(key, *node);
}

double NamedTable::finite(std::string_view key, const toml::node& node) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value) refuse(key, "is no number; write a number without quotes and unit");
  if (!(std::fabs(*value) <= static_cast<double>(std::numeric_limits<float>::max())))
    refuse(key, "is not finite; write the effect's value");
  return *value;
}

std::uint8_t NamedTable::digit(std::string_view key) const {
  const double value = number(key);
  if (!(value >= 0.0 && value <= 9.0 && value == std::floor(value))) refuse(key, "is no whole number from 0");
  return static_cast<std::uint8_t>(value);
}

void NamedTable::check_axis(gap::Effect effect, const MachineDescription& machine) const {
  using gap::EffectGroup;
  const EffectGroup group = gap::info_of(effect).group;
  const bool is_of_spindle = group == EffectGroup::kSpindleTorque || group == EffectGroup::kArmatureVoltage;
  if (is_of_spindle && !machine.has_spindle)
    refuse("name", fmt::format("'{}' needs [spindle]", gap::name_of(effect)));
  if (group == EffectGroup::kFeedForce && !machine.has_feed)
    refuse("name", fmt::format("'{}' needs [feed]", gap::name_of(effect)));
}

}  // namespace morepro::host
