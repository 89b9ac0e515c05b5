#pragma once
#include <string>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/leftover/bursts.hpp"
#include "sim_host/diagnose/leftover/left_lines.hpp"

namespace morepro::host {

/// Structure in what a model leaves: how much of it is predictable, by anything.
struct Leftover {
  double gain = 0.0;  ///< deviance that nameless structure takes: functions, or lines if they take more
  double torque_share = 0.0;  ///< of the gain, spindle axis: the rest is voltage
  double by_functions = 0.0;  ///< deviance that these take
  double torque_share_of_functions = 0.0;
  std::vector<gap::EffectForm> functions{};  ///< that take it, the most important one first
  std::vector<LeftLine> lines{};             ///< none where functions take more
  bool is_lines_only = false;                ///< the functions merely stand in for the lines
  double ringing_hz = 0.0;                   ///< of the resonance that takes most; 0: none does
  std::string changed_values{};              ///< what has become of the machine, where that takes most
  bool wanders = false;          ///< it lasts for longer than random forces do, and follows nothing
  std::vector<Bursts> bursts{};  ///< it is there for moments, where these are all that there is

  /// Is anything known of it beside how much it is?
  [[nodiscard]] bool is_described() const {
    return !functions.empty() || !lines.empty() || !changed_values.empty() || is_beside_noise();
  }
  /// Does it count whatever noise may be worth, which was weighed already?
  [[nodiscard]] bool is_beside_noise() const { return ringing_hz > 0.0 || wanders || !bursts.empty(); }
};

/// Smooth functions of what is measured, and lines in the spectrum over time and over the spindle's angle.
Leftover leftover_of(const AxisFit& fit, double least_evidence);

/// Where there are lines and functions: which of them stand in for the others. `with_functions`: a model that
/// has them.
void tell_lines_from_functions(const AxisFit& with_functions, Leftover& leftover);

}  // namespace morepro::host
