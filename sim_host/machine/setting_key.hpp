#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

/// One number of a machine file that has a default.
struct SettingKey {
  std::string_view table;
  std::string_view key;
  std::string_view part;  ///< table of the machine file without which nothing uses the value
  double (*get)(const MonitorConfiguration& configuration);
  void (*set)(MonitorConfiguration& configuration, double value);
  /// What the value is chosen from while nobody states it; empty: the default is a fixed number.
  std::string_view origin = {};
  double lowest = 0.0;
  double highest = std::numeric_limits<double>::infinity();
  bool may_be_lowest = true;
  bool may_be_highest = true;
  bool is_whole = false;
};

/// Every number of the tables [bank], [tuning], [gap] and [wear], in the order of the file.
std::span<const SettingKey> setting_keys();

/// "tuning.switch_probability"
std::string full_name(const SettingKey& key);

/// "greater than 0", "a whole number from 1 to 11 (the board's bank holds no more)"
std::string range_text(const SettingKey& key);
bool is_in_range(const SettingKey& key, double value);

/// bank.rule, in the order of DecisionRule.
inline constexpr std::array<std::string_view, 3> kRuleNames{"markov", "bayesian", "thesis"};

}  // namespace morepro::host
