#pragma once
#include <vector>

#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Residual ratio of one balance at whole orders of the spindle's turn: 1 .. 8, teeth and twice the teeth.
/// The innovations of the balance's sensor, before and with the effects, are demodulated by the spindle's
/// angle. None where nothing was found, and where neither speed nor angle of the spindle are recorded.
std::vector<GapCell> order_cells(gap::Balance balance, const AxisDiagnosis& diagnosis);

}  // namespace morepro::host
