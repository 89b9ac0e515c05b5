#include "sim_host/simulate/datasheet.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim_host/machine/machine_key.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

constexpr std::uint64_t kStream = 1000;

bool can_be_wrong(const MachineKey& key) {
  constexpr std::array<std::string_view, 3> kFeedKeys{"mass_kg", "contact_force_n", "viscous_friction_ns_m"};
  if (key.table == "spindle") return true;
  return key.table == "feed" && std::find(kFeedKeys.begin(), kFeedKeys.end(), key.key) != kFeedKeys.end();
}

}  // namespace

MachineParameters datasheet_of(const MachineParameters& machine, double fraction, std::uint64_t seed) {
  MachineParameters datasheet = machine;
  std::uint64_t counter = 0;
  for (const MachineKey& key : machine_keys()) {
    if (!can_be_wrong(key)) continue;
    const bool is_high = (mixed(mixed(seed, kStream), counter++) & 1U) != 0;
    key.of(datasheet) *= is_high ? 1.0 + fraction : 1.0 - fraction;
  }
  return datasheet;
}

}  // namespace morepro::host
