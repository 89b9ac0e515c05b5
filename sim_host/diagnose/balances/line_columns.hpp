#pragma once
#include <Eigen/Core>

#include "sim_host/diagnose/balances/balance_increments.hpp"
#include "sim_host/diagnose/leftover/left_lines.hpp"

namespace morepro::host {

/// That of the sensor that shows it: of the spindle's torque for the speed, of the voltage for the current. A
/// line of the voltage that the speed shows better is given to the torque.
gap::Balance balance_of(Axis axis, const LeftLine& line);

/// Adds a line to what the effects in the model add to a balance: what its increments, less `coefficient`
/// times their columns, hold of it, in pieces so short that a line between two frequencies stays in step.
void add_line(const LeftLine& line, const RecordingSignals& signals, const Eigen::VectorXd& coefficient,
              BalanceIncrements& balance);

}  // namespace morepro::host
