#pragma once
#include <array>
#include <vector>

#include "lib/gap/effect.hpp"
#include "sim_host/diagnose/balances/window_rows.hpp"
#include "sim_host/diagnose/leftover/leftover.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Residual ratio of a balance in which effects act.
inline constexpr double kLeastGap = 1.005;

/// Powers of one balance, window by window, in units of the noise floor: what the recording leaves of a
/// balance that is integrated exactly over every sampling interval, in smooth windows. The floor is the noise
/// of what the model leaves on average, band by band and with and without contact.
struct BalanceRows {
  gap::Balance balance = gap::Balance::kSpindleTorque;
  std::vector<WindowPower> before{};  ///< nominal parameters refitted to these rows
  std::vector<WindowPower> after{};   ///< and the effects, with one common size refitted
  /// The same with sizes fitted to the other half of the windows, 2 s and 2 s in turn; none of what has no
  /// name.
  std::vector<double> held_out_before{};
  std::vector<double> held_out_after{};
};

/// Rows of the balances of an axis that have their signals. `leftover`: what the model leaves without a name;
/// its lines count as effects.
std::vector<BalanceRows> balance_rows(const AxisDiagnosis& diagnosis, const Leftover* leftover = nullptr);

}  // namespace morepro::host
