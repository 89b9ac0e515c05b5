#include "sim_host/machine/machine_file_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <vector>

#include "lib/monitor/configuration_check.hpp"
#include "sim_host/machine/effect_tables.hpp"
#include "sim_host/machine/machine_key.hpp"
#include "sim_host/machine/machine_rules.hpp"
#include "sim_host/machine/machine_toml.hpp"
#include "sim_host/machine/setting_tables.hpp"

namespace morepro::host {
namespace {

constexpr std::array<std::string_view, 13> kTables{"machine", "spindle",  "feed",    "tool", "contact",
                                                   "thermal", "sampling", "sensors", "bank", "tuning",
                                                   "gap",     "wear",     "effects"};

std::vector<std::string_view> machine_keys_of(std::string_view table) {
  std::vector<std::string_view> names;
  for (const MachineKey& key : machine_keys()) {
    if (key.table == table) names.push_back(key.key);
  }
  if (table == "contact") names.push_back("form");
  if (table == "machine") names.push_back("name");
  if (table == "sampling") names.push_back("rate_hz");
  return names;
}

std::vector<std::string_view> columns() {
  std::vector<std::string_view> names;
  for (const ChannelInfo& info : kChannels) names.push_back(info.column);
  return names;
}

class MachineFile {
 public:
  explicit MachineFile(const std::string& path) : file_(path) {
    machine_.name = std::filesystem::path(path).stem().string();
    machine_.is_built_in = false;
  }

  MachineDescription read() {
    file_.check_names(file_.root(), kTables, "table", "");
    for (auto&& [name, node] : file_.root()) {
      if (name.str() != "effects") (void)file_.table(name.str());
    }
    read_name();
    read_parameters();
    read_sampling();
    read_sensors();
    machine_.places = file_.places();
    check_rules(machine_, file_.path());
    if (const toml::node* effects = file_.root().get("effects"))
      read_effects(*effects, file_.path(), machine_);
    read_settings(file_, machine_);
    if (const toml::node* forms = file_.root().at_path("gap.forms").node())
      read_gap_forms(*forms, file_.path(), machine_);
    machine_.places = file_.places();
    return std::move(machine_);
  }

 private:
  void read_name() {
    const toml::table* table = file_.table("machine");
    if (table == nullptr) return;
    file_.check_names(*table, machine_keys_of("machine"), "key", " of [machine]");
    const toml::node* node = table->get("name");
    if (node == nullptr) return;
    const auto name = node->value<std::string>();
    if (!node->is_string() || name->empty()) {
      throw UserError(file_.place(node->source()), "machine.name is no text; write it between quotes");
    }
    machine_.name = *name;
  }

  void read_parameters() {
    machine_.has_spindle = file_.table("spindle") != nullptr;
    machine_.has_feed = file_.table("feed") != nullptr;
    machine_.has_contact = file_.table("tool") != nullptr && file_.table("contact") != nullptr;
    machine_.has_thermal = file_.table("thermal") != nullptr;
    if (!machine_.has_spindle && !machine_.has_feed) {
      throw UserError({file_.path(), 0, 0},
                      "neither [spindle] nor [feed] is described; add the tables of the axes that exist");
    }
    if (!machine_.has_thermal) set_neutral("thermal", machine_.configuration.machine);
    for (const std::string_view name : {"spindle", "feed", "tool", "contact", "thermal"}) read_table(name);
    if (!machine_.has_thermal) machine_.configuration.machine.thermal.tool_degc = 20.0;
  }

  void read_table(std::string_view name) {
    const toml::table* table = file_.table(name);
    if (table == nullptr) return;
    file_.check_names(*table, machine_keys_of(name), "key", fmt::format(" of [{}]", name));
    if (name == "contact") read_form(*table);
    for (const MachineKey& key : machine_keys()) {
      if (key.table == name) read_parameter(*table, key);
    }
  }

  void read_form(const toml::table& table) {
    const toml::node* node = table.get("form");
    if (node == nullptr) {
      throw UserError(file_.place(table.source()),
                      "[contact] has no 'form'; write form = \"consistent\" or \"thesis\"");
    }
    const auto form = node->value<std::string>();
    if (!node->is_string() || (*form != "consistent" && *form != "thesis")) {
      throw UserError(file_.place(node->source()),
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
          file_.place(table.source()),
          fmt::format("[{}] has no '{}'; add it, no other machine's value is taken", key.table, key.key));
    }
    const double value = file_.number(table, key.table, key.key, key.neutral);
    key.of(machine_.configuration.machine) = value;
    if (!table.contains(key.key)) return;
    const std::string name = full_name(key);
    if (key.range == MachineKey::Range::kPositive && !(value > 0.0)) {
      file_.refuse(name, fmt::format("= {} is impossible; it must be greater than 0", value));
    }
    if (key.range == MachineKey::Range::kNotNegative && !(value >= 0.0)) {
      file_.refuse(name, fmt::format("= {} is impossible; it must not be negative", value));
    }
  }

  void read_sampling() {
    const toml::table* table = file_.table("sampling");
    machine_.has_rate = table != nullptr;
    if (table == nullptr) return;
    file_.check_names(*table, machine_keys_of("sampling"), "key", " of [sampling]");
    if (!table->contains("rate_hz")) {
      throw UserError(file_.place(table->source()),
                      "[sampling] has no 'rate_hz'; add it or remove the table");
    }
    const double rate_hz = file_.number(*table, "sampling", "rate_hz", 0.0);
    if (!(rate_hz >= 100.0 && rate_hz <= 20000.0))
      file_.refuse("sampling.rate_hz", "is outside 100 .. 20000; correct it");
    machine_.configuration.sampling.rate_hz = rate_hz;
  }

  void read_sensors() {
    const toml::table* sensors = file_.table("sensors");
    if (sensors != nullptr) file_.check_names(*sensors, columns(), "sensor", " of [sensors]");
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
      throw UserError(file_.place(node.source()), fmt::format("'{0}' is no table; write [{0}]", name));
    constexpr std::array<std::string_view, 2> kSensorKeys{"noise", "lsb"};
    file_.check_names(*table, kSensorKeys, "key", fmt::format(" of [{}]", name));
    if (!table->contains("noise")) {
      throw UserError(file_.place(table->source()),
                      fmt::format("[{}] has no 'noise'; add its standard deviation", name));
    }
    SensorNoise& sensor = machine_.configuration.sensors[channel];
    sensor = {file_.number(*table, name, "noise", 0.0), file_.number(*table, name, "lsb", 0.0)};
    for (const auto& [key, value] : {std::pair{".noise", sensor.noise}, std::pair{".lsb", sensor.lsb}}) {
      if (!has_possible_magnitude(value, detail::kLargestNoise)) file_.refuse_magnitude(name + key, value);
    }
    if (!(sensor.noise >= 0.0)) file_.refuse(name + ".noise", "is negative, which is impossible; correct it");
    if (!(sensor.lsb >= 0.0)) file_.refuse(name + ".lsb", "is negative, which is impossible; correct it");
    if (info_of(channel).kind == ChannelKind::kSampled && !(sensor.variance() > 0.0))
      file_.refuse(name + ".noise", "is 0 and so is the lsb; no sensor is exact, give one of them");
  }

  MachineToml file_;
  MachineDescription machine_;
};

}  // namespace

MachineDescription read_machine_file(const std::string& path) { return MachineFile(path).read(); }

}  // namespace morepro::host
