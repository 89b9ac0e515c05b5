#pragma once
#include <vector>

#include "sim_host/diagnose/balances/balance_rows.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Residual ratio of the balances of one axis, as a whole and cell by cell.
std::vector<BalanceResult> balances_of(const AxisDiagnosis& diagnosis, const std::vector<BalanceRows>& rows);

/// Time at which an effect sets in: the split of the recording that is likelier than a constant size by more
/// than chance makes it; nothing where it is there from the start.
std::optional<double> onset_of(const AxisDiagnosis& diagnosis, const gap::AppliedEffect& effect);

}  // namespace morepro::host
