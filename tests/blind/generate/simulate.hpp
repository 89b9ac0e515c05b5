#pragma once
#include <vector>

#include "excitation.hpp"
#include "plant.hpp"

namespace blind {

/// Random load and ripple: standard deviations, correlation time and how much louder they are in the cut.
struct ProcessNoise {
  double torque_nm = 0.0, force_n = 0.0, voltage_v = 0.0;
  double correlation_s = 1e-3;
  double contact_gain = 1.0;
};

/// One sampled row; inputs are held until the next one.
struct Row {
  double time_s = 0.0;
  Inputs in;
  Reading seen;
  double tool_c = 0.0, winding_c = 0.0;
  bool is_missing = false;
};

struct Run {
  std::vector<Row> rows;
  double sample_s = 1e-4;
  bool is_finite = true;
};

/// Everything of a run but its effects.
struct Scenario {
  Machine machine;
  Excitation excitation;
  ProcessNoise process;
  bool controllers_see_state = false;  ///< instead of what the sensors deliver
  std::uint64_t seed = 1;

  double duration_s() const { return static_cast<double>(excitation.contact.size()) * excitation.sample_s; }
};

/// The machine in closed loop; the controllers act once per sample.
Run simulate(const Scenario& scenario, const std::vector<ActiveEffect>& effects);

}  // namespace blind
