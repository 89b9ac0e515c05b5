#include "sim_host/simulate/operating_point.hpp"

namespace morepro::host {
namespace {

double changed_chip_load(const MachineParameters& machine) {
  const bool is_thesis = machine.contact.form == ContactForm::kThesis;
  const double less_mm = (is_thesis ? 0.6 : 0.8) * machine.tool.chip_load_mm;
  return is_inside_contact_range(machine, less_mm) ? less_mm : 1.2 * machine.tool.chip_load_mm;
}

}  // namespace

OperatingPoint operating_point_of(const MachineParameters& machine) {
  return {gap::steady_cut_of(machine), changed_chip_load(machine)};
}

}  // namespace morepro::host
