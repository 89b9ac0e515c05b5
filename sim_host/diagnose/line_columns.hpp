#pragma once
#include <Eigen/Core>

#include "sim_host/diagnose/balance_increments.hpp"
#include "sim_host/diagnose/leftover.hpp"

namespace morepro::host {

gap::Balance balance_of(Axis axis, const LeftLine& line);

/// Adds a line to what the effects in the model add to a balance: what its increments, less `coefficient`
/// times their columns, hold of it, in pieces so short that a line between two frequencies stays in step.
void add_line(const LeftLine& line, const RecordingSignals& signals, const Eigen::VectorXd& coefficient,
              BalanceIncrements& balance);

}  // namespace morepro::host
