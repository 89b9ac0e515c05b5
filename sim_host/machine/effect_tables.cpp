#include "sim_host/machine/effect_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/machine/effect_rules.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 6> kKeys{"name", "size", "kind", "shape", "coefficients", "onset_s"};

/// One table of the array.
class EffectTable {
 public:
  EffectTable(const toml::table& table, const std::string& path) : table_(table), path_(path) {}

  [[nodiscard]] gap::AppliedEffect read(const MachineParameters& machine) {
    check_keys();
    const gap::Effect effect = read_name();
    const gap::EffectScales<double> scales(machine, {});
    const double size = number("size");
    if (const std::string objection = objection_to_size(effect, size); !objection.empty())
      refuse("size", objection);
    gap::AppliedEffect one = gap::applied(effect, size, scales);
    refine(one);
    if (const std::string objection = objection_to_form(one.form); !objection.empty() && size != 0.0)
      refuse("name", fmt::format("'{}' {}", gap::name_of(effect), objection));
    check_consistent(gap::size_of(one, scales), size);
    return one;
  }

  [[noreturn]] void refuse(std::string_view key, const std::string& sentence) const {
    const toml::node* node = table_.get(key);
    const auto source = (node == nullptr ? table_ : *node).source().begin;
    throw UserError({path_, source.line, source.column}, fmt::format("effects.{}: {}", key, sentence));
  }

 private:
  void check_keys() const {
    for (auto&& [key, node] : table_) {
      if (std::find(kKeys.begin(), kKeys.end(), key.str()) != kKeys.end()) continue;
      refuse(key.str(),
             fmt::format("this key is not known{}; correct or remove it", did_you_mean(key.str(), kKeys)));
    }
  }

  [[nodiscard]] gap::Effect read_name() const {
    const auto name = table_["name"].value<std::string>();
    if (!name) refuse("name", "every [[effects]] needs the name of an effect between quotes");
    if (const auto effect = gap::effect_named(*name)) return *effect;
    std::vector<std::string_view> names;
    for (const gap::EffectInfo& info : gap::kEffects) names.push_back(info.name);
    refuse("name", fmt::format("no effect is called '{}'{}; 'morepro effects' lists them", *name,
                               did_you_mean(*name, names)));
  }

  [[nodiscard]] double number(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) refuse(key, fmt::format("every [[effects]] needs its {}; add it", key));
    return finite(key, *node);
  }

  [[nodiscard]] double finite(std::string_view key, const toml::node& node) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value) refuse(key, "is no number; write a number without quotes and unit");
    if (!(std::fabs(*value) <= static_cast<double>(std::numeric_limits<float>::max())))
      refuse(key, "is not finite; write the effect's value");
    return *value;
  }

  void refine(gap::AppliedEffect& one) const {
    if (table_.contains("kind")) one.form.kind = whole_kind();
    if (table_.contains("shape")) one.form.shape = static_cast<float>(number("shape"));
    if (table_.contains("onset_s")) one.onset_s = number("onset_s");
    if (!(one.onset_s >= 0.0)) refuse("onset_s", "is negative; write a time from the recording's begin");
    if (table_.contains("coefficients")) read_coefficients(one);
  }

  [[nodiscard]] std::uint8_t whole_kind() const {
    const double kind = number("kind");
    if (!(kind >= 0.0 && kind <= 9.0 && kind == std::floor(kind)))
      refuse("kind", "is no whole number from 0");
    return static_cast<std::uint8_t>(kind);
  }

  void read_coefficients(gap::AppliedEffect& one) const {
    const toml::array* values = table_["coefficients"].as_array();
    if (values == nullptr || values->empty() || values->size() > gap::kMostParts)
      refuse("coefficients", fmt::format("write one to {} numbers between brackets", gap::kMostParts));
    one.coefficient = {};
    one.form.parts = static_cast<std::uint8_t>(values->size());
    for (std::size_t i = 0; i < values->size(); ++i)
      one.coefficient[i] = finite("coefficients", *values->get(i));
  }

  void check_consistent(double made, double size) const {
    constexpr double kSlack = 1.0e-3;  // a size may be written with four digits
    if (std::fabs(made - size) <= kSlack * std::fabs(size)) return;
    refuse("size", fmt::format("= {:g}, but shape and coefficients make it {:g}; change both, or remove them",
                               size, made));
  }

  const toml::table& table_;
  const std::string& path_;
};

void check_axis(const EffectTable& table, gap::Effect effect, const MachineDescription& machine) {
  using gap::EffectGroup;
  const EffectGroup group = gap::info_of(effect).group;
  const bool is_of_spindle = group == EffectGroup::kSpindleTorque || group == EffectGroup::kArmatureVoltage;
  if (is_of_spindle && !machine.has_spindle)
    table.refuse("name", fmt::format("'{}' needs [spindle]", gap::name_of(effect)));
  if (group == EffectGroup::kFeedForce && !machine.has_feed)
    table.refuse("name", fmt::format("'{}' needs [feed]", gap::name_of(effect)));
}

}  // namespace

void read_effects(const toml::node& node, const std::string& path, MachineDescription& machine) {
  const toml::array* tables = node.as_array();
  const auto place = node.source().begin;
  if (tables == nullptr || !tables->is_array_of_tables())
    throw UserError({path, place.line, place.column}, "'effects' is no list of tables; write [[effects]]");
  for (const toml::node& element : *tables) {
    EffectTable table(*element.as_table(), path);
    machine.effects.push_back(table.read(machine.configuration.machine));
    check_axis(table, machine.effects.back().form.effect, machine);
  }
}

}  // namespace morepro::host
