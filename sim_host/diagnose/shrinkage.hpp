#pragma once
#include <cstdint>
#include <span>

#include "sim_host/diagnose/axis_diagnosis.hpp"
#include "sim_host/diagnose/balance_rows.hpp"
#include "sim_host/diagnose/diagnosis_result.hpp"

namespace morepro::host {

/// Share closed over all balances with its 90 % interval, by drawing pieces anew. `leftover[i]`: deviance of the
/// structure that stays in balance i.
void share_closed(std::span<const BalanceRows> balances, std::span<const double> leftover, std::uint64_t seed,
                  Shrinkage& shrinkage);

/// One-step and free-run errors of an axis, relative to the standard deviation of what is measured.
void compare_models(const AxisDiagnosis& diagnosis, Shrinkage& shrinkage);

}  // namespace morepro::host
