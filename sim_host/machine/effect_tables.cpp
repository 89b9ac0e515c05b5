#include "sim_host/machine/effect_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/machine/effect_rules.hpp"
#include "sim_host/machine/named_table.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 6> kEffectKeys{"name",  "size",         "kind",
                                                      "shape", "coefficients", "onset_s"};
constexpr std::array<std::string_view, 4> kFormKeys{"name", "kind", "shape", "parts"};

void read_coefficients(gap::AppliedEffect& one, const NamedTable& table) {
  const toml::array* values = table.table()["coefficients"].as_array();
  if (values == nullptr || values->empty() || values->size() > gap::kMostParts)
    table.refuse("coefficients", fmt::format("write one to {} numbers between brackets", gap::kMostParts));
  one.coefficient = {};
  one.form.parts = static_cast<std::uint8_t>(values->size());
  for (std::size_t i = 0; i < values->size(); ++i)
    one.coefficient[i] = table.finite("coefficients", *values->get(i));
}

void check_consistent(double made, double size, const NamedTable& table) {
  constexpr double kSlack = 1.0e-3;  // a size may be written with four digits
  if (std::fabs(made - size) <= kSlack * std::fabs(size)) return;
  table.refuse("size",
               fmt::format("= {:g}, but shape and coefficients make it {:g}; change both, or remove them",
                           size, made));
}

gap::AppliedEffect refined(gap::AppliedEffect one, const NamedTable& table) {
  if (table.has("kind")) one.form.kind = table.digit("kind");
  if (table.has("shape")) one.form.shape = static_cast<float>(table.number("shape"));
  if (table.has("onset_s")) one.onset_s = table.number("onset_s");
  if (!(one.onset_s >= 0.0)) table.refuse("onset_s", "is negative; write a time from the recording's begin");
  if (table.has("coefficients")) read_coefficients(one, table);
  return one;
}

gap::AppliedEffect read_effect(const NamedTable& table, const MachineParameters& machine) {
  table.check_keys(kEffectKeys);
  const gap::Effect effect = table.effect();
  const gap::EffectScales<double> scales(machine, {});
  const double size = table.number("size");
  if (const std::string objection = objection_to_size(effect, size); !objection.empty())
    table.refuse("size", objection);
  const gap::AppliedEffect one = refined(gap::applied(effect, size, scales), table);
  if (const std::string objection = objection_to_form(one.form); !objection.empty() && size != 0.0)
    table.refuse("name", fmt::format("'{}' {}", gap::name_of(effect), objection));
  check_consistent(gap::size_of(one, scales), size, table);
  return one;
}

gap::EffectForm read_form(const NamedTable& table) {
  table.check_keys(kFormKeys);
  gap::EffectForm form{.effect = table.effect()};
  if (gap::info_of(form.effect).group == gap::EffectGroup::kSampling)
    table.refuse("name",
                 fmt::format("'{}' leaves no signature that a board looks for", gap::name_of(form.effect)));
  if (table.has("kind")) form.kind = table.digit("kind");
  if (table.has("parts")) form.parts = table.digit("parts");
  if (table.has("shape")) form.shape = static_cast<float>(table.number("shape"));
  const std::string objection = form.parts > 0 ? objection_to_form(form) : std::string{};
  if (!objection.empty()) table.refuse("name", fmt::format("'{}' {}", gap::name_of(form.effect), objection));
  return form;
}

}  // namespace

void read_effects(const toml::node& node, const std::string& path, MachineDescription& machine) {
  for_each_table(node, "effects", path, [&machine](const NamedTable& table) {
    const gap::AppliedEffect effect = read_effect(table, machine.configuration.machine);
    table.check_axis(effect.form.effect, machine);
    machine.effects.push_back(effect);
  });
}

void read_gap_forms(const toml::node& node, const std::string& path, MachineDescription& machine) {
  GapTuning& gap = machine.configuration.gap;
  for_each_table(node, "gap.forms", path, [&machine, &gap](const NamedTable& table) {
    const gap::EffectForm form = read_form(table);
    table.check_axis(form.effect, machine);
    gap::MachineForms& forms = gap::is_of_feed(form.effect) ? gap.feed.forms : gap.spindle.forms;
    if (!forms.has_room(form))
      table.refuse("name",
                   fmt::format("'{}' is too much: a board has room for {} forms with {} parts in each axis",
                               gap::name_of(form.effect), forms.kMost, forms.kMostParts));
    forms.form[forms.count++] = form;
  });
}

}  // namespace morepro::host
