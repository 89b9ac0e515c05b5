#pragma once
#include "lib/gap/effect_signals.hpp"
#include "lib/plant/machine_parameters.hpp"

namespace morepro::host {

/// Winding and tool as one heat capacity each. The winding is heated by i^2 R; the tool is heated by the cut
/// toward its nominal temperature, where it starts, and cools in the air.
class Temperatures {
 public:
  Temperatures(const MachineParameters& machine, const gap::ReferencePoint& point, double step_s);

  void step(double mean_square_current_a2, double contact);

  [[nodiscard]] double tool_degc() const { return tool_degc_; }
  [[nodiscard]] double winding_degc() const { return winding_degc_; }

 private:
  double winding_share_;
  double heating_share_;
  double cooling_share_;
  double winding_k_per_a2_;
  double nominal_tool_degc_;
  double tool_degc_;
  double winding_degc_;
};

}  // namespace morepro::host
