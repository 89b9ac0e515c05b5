#pragma once
#include <toml++/toml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {

/// Values of a TOML file by key, with line and column in every complaint.
class TomlReader {
 public:
  /// Throws UserError where the file cannot be read or is no TOML.
  explicit TomlReader(const std::string& path);

  [[nodiscard]] const toml::table& root() const { return root_; }
  [[nodiscard]] TextPlace place(const toml::node& node) const;

  /// Refuses every key of `table` that is not among the known ones. `where`: " of [joint]".
  void check_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                  std::string_view where) const;
  /// nullptr where the key is absent.
  [[nodiscard]] const toml::table* table(std::string_view key) const;
  /// The tables [[key]], or key = [{..}, ..]; nullptr where the key is absent.
  [[nodiscard]] const toml::array* tables(std::string_view key) const;

  [[nodiscard]] double number(const toml::node& node, std::string_view key) const;
  /// A finite number at a key, or the fallback.
  [[nodiscard]] double number(const toml::table& table, std::string_view key, double fallback) const;
  /// An angle in rad from KEY_deg or KEY_rad, of which one may be there.
  [[nodiscard]] std::optional<double> angle_rad(const toml::table& table, std::string_view key) const;
  /// Text at a key; empty where the key is absent.
  [[nodiscard]] std::string text(const toml::table& table, std::string_view key) const;

  [[noreturn]] void refuse(const toml::node& node, std::string_view sentence) const;

 private:
  std::string path_;
  toml::table root_;
};

}  // namespace morepro::host
