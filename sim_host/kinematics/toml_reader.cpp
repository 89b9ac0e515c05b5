#include "sim_host/kinematics/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim_host/kinematics/degree.hpp"
#include "sim_host/support/parsed_toml.hpp"
#include "sim_host/support/suggestion.hpp"

namespace morepro::host {
namespace {}  // namespace

TomlReader::TomlReader(const std::string& path) : path_(path), root_(parsed_toml(path)) {}

TextPlace TomlReader::place(const toml::node& node) const {
  return {path_, node.source().begin.line, node.source().begin.column};
}

void TomlReader::refuse(const toml::node& node, std::string_view sentence) const {
  throw UserError(place(node), sentence);
}

void TomlReader::check_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                            std::string_view where) const {
  const std::vector<std::string_view> names(known);
  for (auto&& [key, node] : table) {
    if (std::find(names.begin(), names.end(), key.str()) != names.end()) continue;
    const auto& begin = key.source().begin;
    throw UserError(TextPlace{path_, begin.line, begin.column},
                    fmt::format("'{}'{} is not known{}; correct or remove it", key.str(), where,
                                did_you_mean(key.str(), names)));
  }
}

const toml::table* TomlReader::table(std::string_view key) const {
  const toml::node* node = root_.get(key);
  if (node == nullptr) return nullptr;
  if (const toml::table* table = node->as_table()) return table;
  refuse(*node, fmt::format("'{0}' is no table; write [{0}] above its keys", key));
}

const toml::array* TomlReader::tables(std::string_view key) const {
  const toml::node* node = root_.get(key);
  if (node == nullptr) return nullptr;
  const toml::array* array = node->as_array();
  if (array == nullptr) refuse(*node, fmt::format("'{0}' is no list; write [[{0}]] above each", key));
  for (const toml::node& element : *array) {
    if (!element.is_table())
      refuse(element, fmt::format("'{0}' is no list of tables; write [[{0}]] above each", key));
  }
  return array;
}

double TomlReader::number(const toml::node& node, std::string_view key) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value)
    refuse(node, fmt::format("{} is no number; write a number without quotes and unit", key));
  if (!std::isfinite(*value)) refuse(node, fmt::format("{} is not finite; write a finite number", key));
  return *value;
}

double TomlReader::number(const toml::table& table, std::string_view key, double fallback) const {
  const toml::node* node = table.get(key);
  return node == nullptr ? fallback : number(*node, key);
}

std::optional<double> TomlReader::angle_rad(const toml::table& table, std::string_view key) const {
  const std::string in_degrees = fmt::format("{}_deg", key);
  const std::string in_radians = fmt::format("{}_rad", key);
  const toml::node* degrees = table.get(in_degrees);
  const toml::node* radians = table.get(in_radians);
  if (degrees != nullptr && radians != nullptr)
    refuse(*radians, fmt::format("{} and {} are both there; remove one", in_degrees, in_radians));
  if (degrees != nullptr) return number(*degrees, in_degrees) * kDegree;
  if (radians != nullptr) return number(*radians, in_radians);
  return std::nullopt;
}

std::string TomlReader::text(const toml::table& table, std::string_view key) const {
  const toml::node* node = table.get(key);
  if (node == nullptr) return {};
  const auto value = node->value<std::string>();
  if (!node->is_string() || !value) refuse(*node, fmt::format("{} is no text; write it between quotes", key));
  return *value;
}

}  // namespace morepro::host
