#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/cli/command.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/support/output_file.hpp"
#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr const char* kEffectsExamples =
    "  morepro effects\n"
    "  morepro effects feed_coulomb_friction\n"
    "  morepro effects --machine thesis --json catalogue.json";

using gap::EffectInfo;

struct EffectsArguments {
  std::string name;
  std::string machine = "reference";
  std::string json;
};

const EffectInfo& find(const std::string& name) {
  if (const auto effect = gap::effect_named(name)) return gap::info_of(*effect);
  std::vector<std::string_view> names;
  for (const EffectInfo& info : gap::kEffects) names.push_back(info.name);
  throw UsageError(fmt::format("no effect is called '{}'{}; 'morepro effects' lists them", name,
                               did_you_mean(name, names)));
}

std::string aliases_of(const EffectInfo& info, std::string_view between) {
  std::vector<std::string_view> names;
  for (const gap::Effect alias : info.aliases.list()) names.push_back(gap::name_of(alias));
  if (!info.also_known.empty()) names.push_back(info.also_known);
  return fmt::format("{}", fmt::join(names, between));
}

gap::ReferencePoint reference_of(const EffectsArguments& arguments) {
  return reference_point_of(load_machine(arguments.machine).configuration.machine);
}

std::string reference_text(const gap::ReferencePoint& point) {
  return fmt::format("w0 = {:.4g} rad/s, i0 = {:.4g} A, v0 = {:.4g} m/s, CL0 = {:.4g} mm, T0 = {:.4g} degC",
                     point.speed_rad_s, point.current_a, point.feed_speed_m_s, point.chip_load_mm,
                     point.tool_degc);
}

void print_table(const EffectsArguments& arguments) {
  const std::string reference = reference_text(reference_of(arguments));
  fmt::print("{:<31} {:<17} {:<12} {}\n", "effect", "acts on", "unit", "nothing to see without");
  for (const EffectInfo& info : gap::kEffects)
    fmt::print("{:<31} {:<17} {:<12} {}\n", info.name, name_of(info.group), info.unit, info.excitation);
  fmt::print("\nSizes of contact and feed effects hold at the reference point of '{}':\n{}\n",
             arguments.machine, reference);
  fmt::print("'morepro effects NAME': equation, look-alikes and what separates them.\n");
}

void print_line(std::string_view what, std::string_view text) {
  constexpr std::size_t kWidth = 82;
  while (!text.empty()) {
    std::size_t end = text.size() <= kWidth ? text.size() : text.rfind(' ', kWidth);
    if (end == std::string_view::npos || end == 0) end = text.size();
    fmt::print("{:<16}{}\n", what, text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    what = {};
  }
}

/// e of a law that bends (`gap::laws::bend`).
std::string_view bend_of(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kSpindleStribeckFriction:
      return "exp(8 (w / shape w0)^2 / 9) - 1";
    case gap::Effect::kFeedStribeckFriction:
      return "exp(8 (v / shape v0)^2 / 9) - 1";
    case gap::Effect::kFeedAsymmetricFriction:
      return "|v|/v0 - 1";
    case gap::Effect::kContactChipLoadDependence:
      return "CL/CL0 - 1";
    case gap::Effect::kContactTemperatureDependence:
      return "(T - T0)/100 K";
    case gap::Effect::kToolWearRamp:
    case gap::Effect::kFeedContactDrift:
      return "t_cut/10 s";
    case gap::Effect::kTorqueConstantSaturation:
      return "(i/i0)^2";
    case gap::Effect::kFeedForceSaturation:
      return "(F1/1 N)^2";
    default:
      return "|w|/w0 - 1";
  }
}

/// What a second coefficient is; empty where there is none, or where it is the phase.
std::string second_part_of(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kFeedPresliding:
      return "F = -a z - b dz/dt, b in N s, damps the bristle";
    case gap::Effect::kFeedSpring:
      return "F = -a (x - first position) - b, b in N, for another place to rest";
    case gap::Effect::kShaftCompliance:
      return "a = J2/J1, b = 1 + a where the cut loads J2, not J1";
    default:
      return gap::bends(effect) ? fmt::format("a becomes a + b e, e = {}", bend_of(effect)) : std::string();
  }
}

/// Another law of the same effect; empty where there is none.
std::string second_kind_of(gap::Effect effect) {
  switch (effect) {
    case gap::Effect::kSpindleCoulombFriction:
      return "kind = 1 in a machine file: M = -a z, dz/dth = (sign(w) - z) / shape (Dahl), shape in rad";
    case gap::Effect::kToothPassingTorque:
      return "kind = 2 in a machine file: it brakes either way, M = -Fc a sign(w) sin(z th + phase)";
    default:
      return {};
  }
}

void print_detail(const EffectInfo& info, const EffectsArguments& arguments) {
  const std::string aliases = aliases_of(info, ", ");
  const std::string reference = reference_text(reference_of(arguments));
  print_line("effect", info.name);
  print_line("acts on", name_of(info.group));
  print_line("size a in", info.unit);
  print_line("equation", info.equation);
  if (const std::string second = second_part_of(info.effect); !second.empty())
    print_line("finer", "coefficients = [a, b] in a machine file: " + second);
  if (const std::string second = second_kind_of(info.effect); !second.empty()) print_line("also", second);
  print_line("reference point", fmt::format("{} ({})", reference, arguments.machine));
  print_line("needs", info.excitation);
  print_line("looks like", aliases.empty() ? "no other" : aliases);
  print_line("separated by", info.separate_by);
}

nlohmann::ordered_json json_of(const EffectInfo& info) {
  nlohmann::ordered_json aliases = nlohmann::ordered_json::array();
  for (const gap::Effect alias : info.aliases.list()) aliases.push_back(gap::name_of(alias));
  return {{"effect", info.name},
          {"balance", name_of(info.group)},
          {"unit", info.unit},
          {"equation", info.equation},
          {"excitation", info.excitation},
          {"aliases", aliases},
          {"other_causes", info.also_known},
          {"separate_by", info.separate_by}};
}

void write_json(const EffectsArguments& arguments) {
  nlohmann::ordered_json effects = nlohmann::ordered_json::array();
  for (const EffectInfo& info : gap::kEffects) {
    if (arguments.name.empty() || info.name == arguments.name) effects.push_back(json_of(info));
  }
  OutputFile file(arguments.json);
  file.write(nlohmann::ordered_json{{"schema", "morepro.effects/1"}, {"effects", effects}}.dump(2) + "\n");
  file.commit();
}

void run(const EffectsArguments& arguments) {
  const EffectInfo* one = arguments.name.empty() ? nullptr : &find(arguments.name);
  if (arguments.json == "-") return write_json(arguments);
  if (one != nullptr) {
    print_detail(*one, arguments);
  } else {
    print_table(arguments);
  }
  if (!arguments.json.empty()) write_json(arguments);
}

}  // namespace

void add_effects(CLI::App& program) {
  auto arguments = std::make_shared<EffectsArguments>();
  CLI::App* command = program.add_subcommand(
      "effects", "list what a machine can have beyond its model, or explain one effect");
  command->add_option("name", arguments->name, "effect to explain; without it all are listed");
  command
      ->add_option("--machine", arguments->machine,
                   "machine whose reference point is shown: 'reference', 'thesis' or a machine file")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "write the catalogue as JSON; '-': on standard output");
  add_examples(*command, "", kEffectsExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
