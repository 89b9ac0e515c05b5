#pragma once
#include <toml++/toml.h>

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {

/// The tables and numbers of a machine file; every complaint says line, column and key.
class MachineToml {
 public:
  /// Throws UserError where the file cannot be read or is no TOML.
  explicit MachineToml(const std::string& path);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const toml::table& root() const { return root_; }
  [[nodiscard]] TextPlace place(const toml::source_region& source) const;
  /// Of every number that was read, as "table.key".
  [[nodiscard]] const std::map<std::string, TextPlace, std::less<>>& places() const { return places_; }

  /// nullptr where the file has no such table.
  [[nodiscard]] const toml::table* table(std::string_view name) const;
  /// Refuses every key of `table` that is not among the known ones. `kind`: "key"; `where`: " of [tool]".
  void check_names(const toml::table& table, std::span<const std::string_view> known, std::string_view kind,
                   std::string_view where) const;
  /// The finite number at a key; the fallback where the key is absent.
  double number(const toml::table& table, std::string_view table_name, std::string_view key, double fallback);

  /// `name`: of a number that was read.
  [[noreturn]] void refuse(const std::string& name, std::string_view sentence) const;
  [[noreturn]] void refuse_magnitude(const std::string& name, double value) const;

 private:
  std::string path_;
  toml::table root_;
  std::map<std::string, TextPlace, std::less<>> places_;
};

}  // namespace morepro::host
