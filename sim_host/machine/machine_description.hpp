#pragma once
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "lib/gap/applied_effect.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {

constexpr std::uint16_t bits_of(std::initializer_list<Channel> channels) {
  std::uint16_t bits = 0;
  for (const Channel channel : channels) bits = static_cast<std::uint16_t>(bits | bit_of(channel));
  return bits;
}

/// A machine as the program knows it: what the monitor is configured with, and what of it was really
/// described.
struct MachineDescription {
  std::string name;
  MonitorConfiguration configuration;
  std::vector<gap::AppliedEffect> effects;  ///< [[effects]]: what the machine has beyond the nominal model
  bool has_spindle = true;                  ///< [spindle]
  bool has_feed = true;                     ///< [feed]
  bool has_contact = true;  ///< [tool] and [contact]: without them there is no chip load to estimate
  bool has_thermal = true;  ///< [thermal]: without it the contact law does not depend on temperature
  bool has_rate = true;     ///< [sampling]: without it the recording's rate is taken
  bool is_built_in = true;
  std::uint16_t assumed_noise =
      0;  ///< bit_of(channel): the reference machine's noise stands in for an absent one
  /// "tuning.switch_probability": settings that do not follow from the rest.
  std::set<std::string, std::less<>> stated;
  std::map<std::string, TextPlace, std::less<>> places;  ///< of every key in the machine file, as "table.key"

  /// bit_of(channel) of the signals that the description can do something with. What is not described is not
  /// evaluated: its signals are not shown to the monitor.
  [[nodiscard]] std::uint16_t usable_channels() const;
};

/// The built-in machine of that name; throws UsageError for another name.
MachineDescription built_in_machine(std::string_view name);
bool is_built_in_name(std::string_view name);

/// A built-in machine by its name, or a machine file by its path.
MachineDescription load_machine(const std::string& name_or_path);

}  // namespace morepro::host
