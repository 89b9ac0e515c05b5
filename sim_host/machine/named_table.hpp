#pragma once
#include <fmt/format.h>
#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>

#include "lib/gap/effect_form.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// One table of a machine file's list of tables that names an effect. Whatever is wrong throws UserError with
/// line and column.
class NamedTable {
 public:
  /// `list`: how the list is called, such as "effects".
  NamedTable(const toml::table& table, std::string_view list, const std::string& path)
      : table_(table), list_(list), path_(path) {}

  [[noreturn]] void refuse(std::string_view key, const std::string& sentence) const;
  void check_keys(std::span<const std::string_view> known) const;
  [[nodiscard]] gap::Effect effect() const;
  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] double finite(std::string_view key, const toml::node& node) const;
  /// A whole number from 0 to 9.
  [[nodiscard]] std::uint8_t digit(std::string_view key) const;
  [[nodiscard]] const toml::table& table() const { return table_; }
  /// Does the machine have what the effect acts on?
  void check_axis(gap::Effect effect, const MachineDescription& machine) const;

 private:
  const toml::table& table_;
  std::string_view list_;
  const std::string& path_;
};

/// The tables of a list, each as a NamedTable: visit(table).
template <class Visit>
void for_each_table(const toml::node& node, std::string_view list, const std::string& path, Visit visit) {
  const toml::array* tables = node.as_array();
  const auto place = node.source().begin;
  if (tables == nullptr || !tables->is_array_of_tables())
    throw UserError({path, place.line, place.column},
                    fmt::format("'{0}' is no list of tables; write [[{0}]]", list));
  for (const toml::node& element : *tables) visit(NamedTable(*element.as_table(), list, path));
}

}  // namespace morepro::host
