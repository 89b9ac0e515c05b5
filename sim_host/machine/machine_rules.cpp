#include "sim_host/machine/machine_rules.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/monitor/configuration_check.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro::host {
namespace {

[[noreturn]] void refuse(const MachineDescription& machine, std::string_view key,
                         const std::string& sentence) {
  throw UserError(machine.places.find(key)->second, fmt::format("{} {}", key, sentence));
}

void check_thermal(const MachineDescription& machine) {
  const auto& thermal = machine.configuration.machine.thermal;
  if (!machine.has_thermal || thermal.melting_degc > thermal.reference_degc) return;
  refuse(machine, "thermal.melting_degc",
         fmt::format("= {} is impossible; it must be above thermal.reference_degc = {}", thermal.melting_degc,
                     thermal.reference_degc));
}

void check_teeth(const MachineDescription& machine) {
  const double teeth = machine.configuration.machine.tool.teeth;
  if (!machine.places.contains("tool.teeth") || (teeth >= 1.0 && teeth == std::round(teeth))) return;
  refuse(machine, "tool.teeth", fmt::format("= {} is impossible; it is a whole number from 1", teeth));
}

void check_chip_load(const MachineDescription& machine) {
  const MachineParameters& parameters = machine.configuration.machine;
  if (!machine.has_contact || is_inside_contact_range(parameters, parameters.tool.chip_load_mm)) return;
  refuse(machine, "tool.chip_load_mm",
         fmt::format("= {} with {} teeth is outside the consistent contact law; choose {:.4g} .. {:.4g} mm",
                     parameters.tool.chip_load_mm, parameters.tool.teeth,
                     ContactRange::kLowestFeed / parameters.tool.teeth,
                     ContactRange::kHighestFeed / parameters.tool.teeth));
}

void check_tables(const MachineDescription& machine, const std::string& path) {
  const bool has_law =
      machine.places.contains("contact.radius_m") || machine.places.contains("contact.viscous_gain_nms");
  if (has_law && !machine.has_contact) {
    throw UserError({path, 0, 0},
                    "[contact] needs [tool]; add the tool's diameter_mm, teeth and chip_load_mm");
  }
}

}  // namespace

bool has_possible_magnitude(double value, double largest) {
  const double magnitude = std::fabs(value);
  return magnitude == 0.0 || (magnitude >= detail::kSmallest && magnitude <= largest);
}

void check_rules(const MachineDescription& machine, const std::string& path) {
  check_tables(machine, path);
  check_thermal(machine);
  check_teeth(machine);
  check_chip_load(machine);
}

}  // namespace morepro::host
