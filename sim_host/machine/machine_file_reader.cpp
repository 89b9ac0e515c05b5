#include "sim_host/machine/machine_file_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <vector>

#include "lib/monitor/configuration_check.hpp"
#include "sim_host/machine/effect_tables.hpp"
#include "sim_host/machine/estimator_choice.hpp"
#include "sim_host/machine/machine_key.hpp"
#include "sim_host/machine/machine_rules.hpp"
#include "sim_host/machine/setting_key.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 11> kTables{"machine", "spindle", "feed",     "tool",
                                                   "contact", "thermal", "sampling", "sensors",
                                                   "effects", "gap",     "wear"};

std::vector<std::string_view> keys_of(std::string_view table) {
  std::vector<std::string_view> names;
  for (const MachineKey& key : machine_keys()) {
    if (key.table == table) names.push_back(key.key);
  }
  if (table == "contact") names.push_back("form");
  if (table == "machine") names.push_back("name");
  if (table == "sampling") names.push_back("rate_hz");
  if (table == "gap")
    for (const GapKey& key : gap_keys()) names.push_back(key.key);
  if (table == "wear")
    for (const WearKey& key : wear_keys()) names.push_back(key.key);
  return names;
}

std::vector<std::string_view> sampled_columns() {
  std::vector<std::string_view> names;
  for (const ChannelInfo& info : kChannels) {
    if (info.kind == ChannelKind::kSampled) names.push_back(info.column);
  }
  return names;
}

class MachineFile {
 public:
  explicit MachineFile(const std::string& path) : path_(path) {
    machine_.name = std::filesystem::path(path).stem().string();
    machine_.is_built_in = false;
  }

  MachineDescription read() {
    root_ = parse();
    check_names(root_, kTables, "table", "");
    for (auto&& [name, node] : root_) {
      if (name.str() != "effects") (void)table_at(name.str());
    }
    read_name();
    read_parameters();
    read_sampling();
    read_sensors();
    check_rules(machine_, path_);
    if (const toml::node* effects = root_.get("effects")) read_effects(*effects, path_, machine_);
    choose_estimators(machine_.configuration, machine_.has_contact);
    read_gap();
    read_wear();
    return std::move(machine_);
  }

 private:
  [[nodiscard]] TextPlace place(const toml::source_region& source) const {
    return {path_, source.begin.line, source.begin.column};
  }

  toml::table parse() const {
    const InputFile file(path_);
    try {
      return toml::parse(file.text(), path_);
    } catch (const toml::parse_error& error) {
      std::string sentence(error.description());
      std::replace(sentence.begin(), sentence.end(), '\n', ' ');
      throw UserError(place(error.source()), fmt::format("no valid TOML: {}; correct this place", sentence));
    }
  }

  /// nullptr where the file has no such table.
  const toml::table* table_at(std::string_view name) const {
    const toml::node* node = root_.get(name);
    if (node == nullptr) return nullptr;
    if (const toml::table* table = node->as_table()) return table;
    throw UserError(place(node->source()),
                    fmt::format("'{0}' is no table; write [{0}] above its keys", name));
  }

  template <typename Names>
  void check_names(const toml::table& table, const Names& known, std::string_view kind,
                   std::string_view where) const {
    for (auto&& [key, node] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      throw UserError(place(key.source()), fmt::format("{} '{}'{} is not known{}; correct or remove it", kind,
                                                       key.str(), where, did_you_mean(key.str(), known)));
    }
  }

  /// The finite number at a key; the fallback where the key is absent.
  double number(const toml::table& table, std::string_view table_name, std::string_view key,
                double fallback) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return fallback;
    const std::string name = fmt::format("{}.{}", table_name, key);
    machine_.places[name] = place(node->source());
    const auto value = node->value<double>();
    if (!node->is_number() || !value) refuse(name, "is no number; write a number without quotes and unit");
    if (!std::isfinite(*value)) refuse(name, "is not finite; write the machine's value");
    if (!has_possible_magnitude(*value, detail::kLargest)) refuse_magnitude(name, *value);
    return *value;
  }

  [[noreturn]] void refuse(const std::string& name, std::string_view sentence) const {
    throw UserError(machine_.places.at(name), fmt::format("{} {}", name, sentence));
  }

  [[noreturn]] void refuse_magnitude(const std::string& name, double value) const {
    refuse(name, fmt::format("= {:g} has a magnitude that no machine has; check its unit", value));
  }

  void read_name() {
    const toml::table* table = table_at("machine");
    if (table == nullptr) return;
    check_names(*table, keys_of("machine"), "key", " of [machine]");
    const toml::node* node = table->get("name");
    if (node == nullptr) return;
    const auto name = node->value<std::string>();
    if (!node->is_string() || name->empty()) {
      throw UserError(place(node->source()), "machine.name is no text; write it between quotes");
    }
    machine_.name = *name;
  }

  void read_parameters() {
    machine_.has_spindle = table_at("spindle") != nullptr;
    machine_.has_feed = table_at("feed") != nullptr;
    machine_.has_contact = table_at("tool") != nullptr && table_at("contact") != nullptr;
    machine_.has_thermal = table_at("thermal") != nullptr;
    if (!machine_.has_spindle && !machine_.has_feed) {
      throw UserError({path_, 0, 0},
                      "neither [spindle] nor [feed] is described; add the tables of the axes that exist");
    }
    if (!machine_.has_thermal) set_neutral("thermal", machine_.configuration.machine);
    for (const std::string_view name : {"spindle", "feed", "tool", "contact", "thermal"}) read_table(name);
    if (!machine_.has_thermal) machine_.configuration.machine.thermal.tool_degc = 20.0;
  }

  void read_table(std::string_view name) {
    const toml::table* table = table_at(name);
    if (table == nullptr) return;
    check_names(*table, keys_of(name), "key", fmt::format(" of [{}]", name));
    if (name == "contact") read_form(*table);
    for (const MachineKey& key : machine_keys()) {
      if (key.table == name) read_parameter(*table, key);
    }
  }

  void read_form(const toml::table& table) {
    const toml::node* node = table.get("form");
    if (node == nullptr) {
      throw UserError(place(table.source()),
                      "[contact] has no 'form'; write form = \"consistent\" or \"thesis\"");
    }
    const auto form = node->value<std::string>();
    if (!node->is_string() || (*form != "consistent" && *form != "thesis")) {
      throw UserError(place(node->source()),
                      "contact.form is neither \"consistent\" nor \"thesis\"; write one of them");
    }
    machine_.configuration.machine.contact.form =
        *form == "thesis" ? ContactForm::kThesis : ContactForm::kConsistent;
  }

  [[nodiscard]] bool is_needed(const MachineKey& key) const {
    const bool thesis = machine_.configuration.machine.contact.form == ContactForm::kThesis;
    switch (key.needed) {
      case MachineKey::Needed::kAlways:
        return true;
      case MachineKey::Needed::kByConsistentForm:
        return !thesis;
      case MachineKey::Needed::kByThesisForm:
        return thesis;
      case MachineKey::Needed::kNever:
        return false;
    }
    return false;
  }

  void read_parameter(const toml::table& table, const MachineKey& key) {
    if (!table.contains(key.key) && is_needed(key)) {
      throw UserError(
          place(table.source()),
          fmt::format("[{}] has no '{}'; add it, no other machine's value is taken", key.table, key.key));
    }
    const double value = number(table, key.table, key.key, key.neutral);
    key.of(machine_.configuration.machine) = value;
    if (!table.contains(key.key)) return;
    const std::string name = full_name(key);
    if (key.range == MachineKey::Range::kPositive && !(value > 0.0)) {
      refuse(name, fmt::format("= {} is impossible; it must be greater than 0", value));
    }
    if (key.range == MachineKey::Range::kNotNegative && !(value >= 0.0)) {
      refuse(name, fmt::format("= {} is impossible; it must not be negative", value));
    }
  }

  void read_sampling() {
    const toml::table* table = table_at("sampling");
    machine_.has_rate = table != nullptr;
    if (table == nullptr) return;
    check_names(*table, keys_of("sampling"), "key", " of [sampling]");
    if (!table->contains("rate_hz")) {
      throw UserError(place(table->source()), "[sampling] has no 'rate_hz'; add it or remove the table");
    }
    const double rate_hz = number(*table, "sampling", "rate_hz", 0.0);
    if (!(rate_hz >= 100.0 && rate_hz <= 20000.0))
      refuse("sampling.rate_hz", "is outside 100 .. 20000; correct it");
    machine_.configuration.sampling.rate_hz = rate_hz;
  }

  void read_sensors() {
    const toml::table* sensors = table_at("sensors");
    if (sensors != nullptr) check_names(*sensors, sampled_columns(), "sensor", " of [sensors]");
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const auto channel = static_cast<Channel>(i);
      const toml::node* node = sensors == nullptr ? nullptr : sensors->get(info_of(channel).column);
      if (node != nullptr) {
        read_sensor(channel, *node);
      } else if (machine_.configuration.sensors[channel].noise > 0.0) {
        machine_.assumed_noise = static_cast<std::uint16_t>(machine_.assumed_noise | bit_of(channel));
      }
    }
  }

  void read_sensor(Channel channel, const toml::node& node) {
    const std::string name = fmt::format("sensors.{}", info_of(channel).column);
    const toml::table* table = node.as_table();
    if (table == nullptr)
      throw UserError(place(node.source()), fmt::format("'{0}' is no table; write [{0}]", name));
    constexpr std::array<std::string_view, 2> kKeys{"noise", "lsb"};
    check_names(*table, kKeys, "key", fmt::format(" of [{}]", name));
    if (!table->contains("noise")) {
      throw UserError(place(table->source()),
                      fmt::format("[{}] has no 'noise'; add its standard deviation", name));
    }
    SensorNoise& sensor = machine_.configuration.sensors[channel];
    sensor = {number(*table, name, "noise", 0.0), number(*table, name, "lsb", 0.0)};
    for (const auto& [key, value] : {std::pair{".noise", sensor.noise}, std::pair{".lsb", sensor.lsb}}) {
      if (!has_possible_magnitude(value, detail::kLargestNoise)) refuse_magnitude(name + key, value);
    }
    if (!(sensor.noise >= 0.0)) refuse(name + ".noise", "is negative, which is impossible; correct it");
    if (!(sensor.lsb >= 0.0)) refuse(name + ".lsb", "is negative, which is impossible; correct it");
    if (!(sensor.variance() > 0.0))
      refuse(name + ".noise", "is 0 and so is the lsb; no sensor is exact, give one of them");
  }

  // After the choice of the estimators: what was found out is better than what is usual.
  void read_gap() {
    machine_.has_gap = table_at("gap") != nullptr;
    read_settings("gap", gap_keys(), machine_.configuration.gap);
  }

  void read_wear() {
    WearLimits& wear = machine_.configuration.wear;
    read_settings("wear", wear_keys(), wear);
    if (wear.low_ratio > 1.0)
      refuse("wear.low_ratio", fmt::format("= {} is impossible; it must be at most 1", wear.low_ratio));
    if (wear.replace_ratio >= wear.watch_ratio) return;
    const bool is_own = machine_.places.contains("wear.replace_ratio");
    refuse(is_own ? "wear.replace_ratio" : "wear.watch_ratio",
           fmt::format("makes replace_ratio = {} smaller than watch_ratio = {}; WATCH comes before REPLACE",
                       wear.replace_ratio, wear.watch_ratio));
  }

  template <typename Settings>
  void read_settings(std::string_view name, std::span<const SettingKey<Settings>> keys, Settings& settings) {
    const toml::table* table = table_at(name);
    if (table == nullptr) return;
    check_names(*table, keys_of(name), "key", fmt::format(" of [{}]", name));
    for (const SettingKey<Settings>& key : keys) {
      double& value = key.of(settings);
      value = number(*table, name, key.key, value);
      if (!table->contains(key.key)) continue;
      if (value > key.lowest || (key.may_be_lowest && value == key.lowest)) continue;
      refuse(fmt::format("{}.{}", name, key.key),
             fmt::format("= {} is impossible; it must be {} {}", value,
                         key.may_be_lowest ? "at least" : "greater than", key.lowest));
    }
  }

  std::string path_;
  toml::table root_;
  MachineDescription machine_;
};

}  // namespace

MachineDescription read_machine_file(const std::string& path) { return MachineFile(path).read(); }

}  // namespace morepro::host
